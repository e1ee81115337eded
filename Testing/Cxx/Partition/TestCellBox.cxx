// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactPredicates3.h"

#include "DegenerateCells.h"
#include "ExactClipping.h"

#include <gtest/gtest.h>

using tipp::Box3;
using tipp::Point2;
using tipp::Point3;

namespace
{

constexpr Point3 O = { 0, 0, 0 };

Point2 flat(const Point3& p)
{
  return { p.x, p.y };
}

// How often each result was returned.
struct Answers
{
  int Apart = 0;
  int Meet = 0;
};

template <typename Draw, typename Test, typename Oracle>
Answers compare(int count, Draw draw, Test test, Oracle oracle)
{
  Answers answers;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i)
  {
    const CellAndBox scene = draw();
    const bool expected = oracle(scene);
    ++(expected ? answers.Meet : answers.Apart);
    EXPECT_EQ(expected, test(scene)) << testing::PrintToString(scene);
  }
  return answers;
}

template <typename Draw>
void compareTriangles(int count, Draw draw)
{
  const Answers answers = compare(
    count, draw,
    [](const CellAndBox& s)
    {
      return tipp::triangleMeetsBox(
        flat(s.Corners[0]), flat(s.Corners[1]), flat(s.Corners[2]), s.Box);
    },
    [](const CellAndBox& s) {
      return oracle::triangleMeetsBox({ s.Corners[0], s.Corners[1], s.Corners[2] }, s.Box);
    });
  EXPECT_GT(answers.Apart, count / 20);
  EXPECT_GT(answers.Meet, count / 20);
}

template <typename Draw>
void compareTetrahedra(int count, Draw draw)
{
  const Answers answers = compare(
    count, draw,
    [](const CellAndBox& s)
    {
      return tipp::tetrahedronMeetsBox(
        s.Corners[0], s.Corners[1], s.Corners[2], s.Corners[3], s.Box);
    },
    [](const CellAndBox& s) { return oracle::tetrahedronMeetsBox(s.Corners, s.Box); });
  EXPECT_GT(answers.Apart, count / 20);
  EXPECT_GT(answers.Meet, count / 20);
}

template <typename Draw>
void compareTrianglesInSpace(int count, Draw draw)
{
  const Answers answers = compare(
    count, draw,
    [](const CellAndBox& s)
    {
      return tipp::tetrahedronMeetsBox(
        s.Corners[0], s.Corners[1], s.Corners[2], s.Corners[2], s.Box);
    },
    [](const CellAndBox& s) {
      return oracle::triangleMeetsBox({ s.Corners[0], s.Corners[1], s.Corners[2] }, s.Box);
    });
  EXPECT_GT(answers.Apart, count / 20);
  EXPECT_GT(answers.Meet, count / 20);
}

template <typename Draw>
void compareOrientations(int count, Draw draw)
{
  std::array<int, 3> answers = {};
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i)
  {
    const auto p = draw().Corners;
    const int expected = oracle::orientation3(p);
    ++answers[static_cast<std::size_t>(expected + 1)];
    EXPECT_EQ(expected, tipp::orientation3(p[0], p[1], p[2], p[3])) << testing::PrintToString(p);
    EXPECT_EQ(expected, tipp::orientation3Exact(p[0], p[1], p[2], p[3]));
    EXPECT_EQ(-expected, tipp::orientation3(p[1], p[0], p[2], p[3]));
  }
  EXPECT_GT(answers[0], 0);
  EXPECT_GT(answers[2], 0);
}

} // namespace

TEST(Orientation3, IsPositiveForATetrahedronInVtksOrder)
{
  EXPECT_EQ(1, tipp::orientation3(O, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }));
  EXPECT_EQ(-1, tipp::orientation3(O, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, -1 }));
  EXPECT_EQ(0, tipp::orientation3(O, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 7, 0 }));
}

TEST(Orientation3, ExactOnLatticesAndAnUlpBesideThem)
{
  DegenerateCells draw(1, 3);
  compareOrientations(50000, [&] { return draw.onLattice(4, 1.0, 1e6); });
  compareOrientations(50000, [&] { return draw.onLattice(5, 0.1, 0.3); });
  compareOrientations(50000, [&] { return draw.besideLattice(4, 0.1, -0.7); });
}

TEST(Orientation3, ExactForMixedExponents)
{
  DegenerateCells draw(2, 3);
  compareOrientations(2000, [&] { return draw.mixedExponents(-1030, 1000); });
  compareOrientations(10000, [&] { return draw.mixedExponents(-40, 40); });
  compareOrientations(5000, [&] { return draw.mixedExponents(-400, -300); });
}

TEST(TriangleMeetsBox, TouchingAtOnePointCounts)
{
  // The hypotenuse passes through the corner (1, 1) of the box.
  EXPECT_TRUE(tipp::triangleMeetsBox({ 0, 0 }, { 2, 0 }, { 0, 2 }, { { 1, 1, 0 }, { 3, 3, 0 } }));
  const double beyond = std::nextafter(1.0, 2.0);
  EXPECT_FALSE(
    tipp::triangleMeetsBox({ 0, 0 }, { 2, 0 }, { 0, 2 }, { { beyond, 1, 0 }, { 3, 3, 0 } }));
}

TEST(TriangleMeetsBox, ABoxWithinTheTriangleAndATriangleWithinTheBoxMeet)
{
  EXPECT_TRUE(
    tipp::triangleMeetsBox({ -9, -9 }, { 9, -9 }, { 0, 9 }, { { -1, -1, 0 }, { 1, 1, 0 } }));
  EXPECT_TRUE(
    tipp::triangleMeetsBox({ -9, -9 }, { 9, -9 }, { 0, 9 }, { { -99, -99, 0 }, { 99, 99, 0 } }));
}

TEST(TriangleMeetsBox, AcceptsSegmentsAndPoints)
{
  const Box3 box = { { 1, 0, 0 }, { 2, 1, 0 } };
  EXPECT_TRUE(tipp::triangleMeetsBox({ 0, 1 }, { 1, 1 }, { 0.5, 1 }, box));
  EXPECT_FALSE(tipp::triangleMeetsBox({ 0, 0.5 }, { 1, 2 }, { 0.5, 1.25 }, box));
  EXPECT_TRUE(tipp::triangleMeetsBox({ 1, 1 }, { 1, 1 }, { 1, 1 }, box));
  EXPECT_FALSE(tipp::triangleMeetsBox({ 0, 1 }, { 0, 1 }, { 0, 1 }, box));
}

TEST(TriangleMeetsBox, ExactOnLattices)
{
  DegenerateCells draw(3, 2);
  compareTriangles(100000, [&] { return draw.onLattice(6, 1.0, -2.0); });
  compareTriangles(100000, [&] { return draw.onLattice(9, 0.1, 0.3); });
}

TEST(TriangleMeetsBox, ExactAnUlpBesideLattices)
{
  DegenerateCells draw(4, 2);
  compareTriangles(100000, [&] { return draw.besideLattice(6, 0.1, 0.0); });
  compareTriangles(50000, [&] { return draw.besideLattice(6, 1e-7, 1e3); });
}

TEST(TriangleMeetsBox, ExactForBoxesWithCornersByTheTriangle)
{
  DegenerateCells draw(5, 2);
  compareTriangles(100000, [&] { return draw.cornerByTheCell(); });
}

TEST(TriangleMeetsBox, ExactForMixedExponents)
{
  DegenerateCells draw(6, 2);
  compareTriangles(3000, [&] { return draw.mixedExponents(-1030, 1000); });
  compareTriangles(20000, [&] { return draw.mixedExponents(-30, 30); });
}

TEST(TetrahedronMeetsBox, TouchingAtOnePointCounts)
{
  const Point3 x = { 3, 0, 0 };
  const Point3 y = { 0, 3, 0 };
  const Point3 z = { 0, 0, 3 };
  const double beyond = std::nextafter(1.0, 2.0);
  EXPECT_TRUE(tipp::tetrahedronMeetsBox(O, x, y, z, { { 1, 1, 1 }, { 2, 2, 2 } }));
  EXPECT_FALSE(tipp::tetrahedronMeetsBox(O, x, y, z, { { 1, beyond, 1 }, { 2, 2, 2 } }));
}

TEST(TetrahedronMeetsBox, EdgesThatPassEachOtherDoNotMeet)
{
  // The first tetrahedron has an edge that crosses the box's edge x = y = 1 at z = 0.5. That of the
  // second one passes slightly farther outside.
  const Box3 box = { { 0, 0, 0 }, { 1, 1, 1 } };
  EXPECT_TRUE(tipp::tetrahedronMeetsBox({ 2, 0, 0 }, { 0, 2, 1 }, { 5, 5, 0 }, { 5, 5, 1 }, box));
  EXPECT_FALSE(tipp::tetrahedronMeetsBox(
    { 2.0000001, 0, 0 }, { 0, 2.0000001, 1 }, { 5, 5, 0 }, { 5, 5, 1 }, box));
}

TEST(TetrahedronMeetsBox, ABoxWithinTheTetrahedronMeetsIt)
{
  EXPECT_TRUE(tipp::tetrahedronMeetsBox(
    { -9, -9, -9 }, { 9, -9, -9 }, { 0, 9, -9 }, { 0, 0, 9 }, { { -1, -1, -5 }, { 1, 1, -4 } }));
}

TEST(TetrahedronMeetsBox, ExactOnLattices)
{
  DegenerateCells draw(7, 3);
  compareTetrahedra(60000, [&] { return draw.onLattice(4, 1.0, -1.0); });
  compareTetrahedra(60000, [&] { return draw.onLattice(7, 0.1, 0.3); });
}

TEST(TetrahedronMeetsBox, ExactAnUlpBesideLattices)
{
  DegenerateCells draw(8, 3);
  compareTetrahedra(60000, [&] { return draw.besideLattice(4, 0.1, 0.0); });
  compareTetrahedra(30000, [&] { return draw.besideLattice(5, 1e-7, 1e3); });
}

TEST(TetrahedronMeetsBox, ExactForBoxesWithCornersByTheTetrahedron)
{
  DegenerateCells draw(9, 3);
  compareTetrahedra(60000, [&] { return draw.cornerByTheCell(); });
}

TEST(TetrahedronMeetsBox, ExactForMixedExponents)
{
  DegenerateCells draw(10, 3);
  compareTetrahedra(2000, [&] { return draw.mixedExponents(-1030, 1000); });
  compareTetrahedra(10000, [&] { return draw.mixedExponents(-30, 30); });
}

TEST(TetrahedronMeetsBox, ExactForTrianglesInSpace)
{
  DegenerateCells draw(11, 3);
  compareTrianglesInSpace(40000, [&] { return draw.onLattice(4, 1.0, -1.0); });
  compareTrianglesInSpace(40000, [&] { return draw.besideLattice(4, 0.1, 0.0); });
  compareTrianglesInSpace(40000, [&] { return draw.cornerByTheCell(); });
}
