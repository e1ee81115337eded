// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapTesting.h"

#include "Overlap/CutFill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// A random mesh whose heights are its values at points.
ValuedMesh hills(int points, std::uint64_t seed, bool corners = false, Point2 shift = { 0, 0 })
{
  ValuedMesh mesh = randomMesh(points, seed, corners, shift);
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    mesh.Points[i].z = mesh.OfPoints[i];
  }
  return mesh;
}

/// Two triangles over the square from (x, 0) to (x + width, width), on a plane of this height, with
/// this slope along x.
ValuedMesh plane(double x, double width, double height, double slope = 0)
{
  ValuedMesh mesh = oneTriangle({ x, 0 }, { x + width, 0 }, { x + width, width }, 0);
  mesh.Points.push_back({ x, width, 0 });
  mesh.OfPoints.push_back(0);
  mesh.Ids.insert(mesh.Ids.end(), { 0, 2, 3 });
  mesh.OfCells.push_back(0);
  for (Point3& p : mesh.Points)
  {
    p.z = height + slope * (p.x - x);
  }
  return mesh;
}

CutFill comparedSurfaces(const ValuedMesh& first, const ValuedMesh& second,
  const std::optional<Box2>& bounds = {}, int threads = 2)
{
  CutFillSums sums(first.view(), bounds, threads);
  EXPECT_TRUE(sums.add(second.view(), {}));
  return sums.result();
}

/// Twice the area of the triangle a, b, p.
mpq_class twiceArea(const ExactPoint& a, const ExactPoint& b, const ExactPoint& p)
{
  return (b.X - a.X) * (p.Y - a.Y) - (b.Y - a.Y) * (p.X - a.X);
}

/// The height at a position in the plane of a triangle of a mesh.
mpq_class heightAt(const ValuedMesh& mesh, std::int64_t cell, const ExactPoint& p)
{
  const ExactPolygon triangle = exactTriangle(mesh, cell);
  const mpq_class whole = twiceArea(triangle[0], triangle[1], triangle[2]);
  mpq_class height = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const mpq_class weight = twiceArea(triangle[(i + 1) % 3], triangle[(i + 2) % 3], p) / whole;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t id = std::size_t(mesh.Ids[std::size_t(3 * cell) + k]);
      height += weight * triangle[i].Weight[k] * mpq_class(mesh.Points[id].z);
    }
  }
  return height;
}

/// The exact volumes over the common part of two triangles: cut, then fill.
void addExact(const ValuedMesh& first, std::int64_t i, const ValuedMesh& second, std::int64_t k,
  const ExactPolygon& part, mpq_class (&volumes)[2])
{
  const auto difference = [&](const ExactPoint& p) -> mpq_class
  { return heightAt(second, k, p) - heightAt(first, i, p); };
  for (std::size_t corner = 2; corner < part.size(); ++corner)
  {
    // Of a triangle with one corner on one side, that corner's part is a smaller triangle.
    const ExactPoint* const at[3] = { &part[0], &part[corner - 1], &part[corner] };
    const mpq_class d[3] = { difference(*at[0]), difference(*at[1]), difference(*at[2]) };
    const mpq_class whole = twiceArea(*at[0], *at[1], *at[2]) / 2 * (d[0] + d[1] + d[2]) / 3;
    mpq_class positive = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const mpq_class& lone = d[a];
      const mpq_class& b = d[(a + 1) % 3];
      const mpq_class& c = d[(a + 2) % 3];
      if (lone > 0 && b <= 0 && c <= 0)
      {
        positive = twiceArea(*at[0], *at[1], *at[2]) / 2 * lone / 3 * (lone / (lone - b)) *
          (lone / (lone - c));
      }
      if (lone < 0 && b >= 0 && c >= 0)
      {
        const mpq_class negative = twiceArea(*at[0], *at[1], *at[2]) / 2 * lone / 3 *
          (lone / (lone - b)) * (lone / (lone - c));
        positive = whole - negative;
      }
    }
    if (d[0] >= 0 && d[1] >= 0 && d[2] >= 0)
    {
      positive = whole;
    }
    volumes[1] += positive;
    volumes[0] += positive - whole;
  }
}

void expectExactVolumes(const ValuedMesh& first, const ValuedMesh& second, double error)
{
  mpq_class area = 0;
  mpq_class volumes[2];
  for (std::int64_t i = 0; i < first.cells(); ++i)
  {
    const ExactPolygon triangle = exactTriangle(first, i);
    for (std::int64_t k = 0; k < second.cells() && !triangle.empty(); ++k)
    {
      ExactPolygon part = exactTriangle(second, k);
      for (std::size_t edge = 0; edge < 3 && !part.empty(); ++edge)
      {
        const ExactPoint& a = triangle[edge];
        const ExactPoint& b = triangle[(edge + 1) % 3];
        part = exactlyClipped(part, a.X, a.Y, b.X, b.Y);
      }
      area += exactArea(part);
      addExact(first, i, second, k, part, volumes);
    }
  }
  const CutFill found = comparedSurfaces(first, second);
  EXPECT_NEAR(found.Area, area.get_d(), error);
  EXPECT_NEAR(found.Cut, volumes[0].get_d(), error);
  EXPECT_NEAR(found.Fill, volumes[1].get_d(), error);
}

} // namespace

TEST(CutFill, OfRandomSurfacesIsExact)
{
  for (std::uint64_t seed = 0; seed < 5; ++seed)
  {
    expectExactVolumes(hills(20, 2 * seed), hills(25, 2 * seed + 1), 1e-15);
  }
}

TEST(CutFill, OfSurfacesFarFromTheOriginIsExact)
{
  const Point2 shift{ 0x1p30, -0x1p31 };
  expectExactVolumes(hills(20, 1, false, shift), hills(25, 2, false, shift), 1e-14);
}

TEST(CutFill, OfHighSurfacesKeepsItsDigits)
{
  ValuedMesh first = hills(20, 1);
  ValuedMesh second = hills(25, 2);
  for (ValuedMesh* const mesh : { &first, &second })
  {
    for (Point3& p : mesh->Points)
    {
      p.z += 0x1p30; // rounds z, which the exact reference uses, too
    }
  }
  expectExactVolumes(first, second, 1e-15);
}

TEST(CutFill, OfParallelPlanesIsAPrism)
{
  const CutFill lower = comparedSurfaces(plane(0, 4, 10), plane(1, 2, 7));
  EXPECT_EQ(lower.Cut, 12);
  EXPECT_EQ(lower.Fill, 0);
  EXPECT_EQ(lower.net(), -12);
  EXPECT_EQ(lower.Area, 4);
  EXPECT_EQ(lower.OnlyFirst, 12);
  EXPECT_EQ(lower.OnlySecond, 0);
}

TEST(CutFill, OfPlanesThatCrossIsTwoWedges)
{
  // The difference is -1 to 3 along x: two triangles, of lengths 1 and 3.
  const CutFill wedges = comparedSurfaces(plane(0, 4, 0), plane(0, 4, -1, 1));
  EXPECT_DOUBLE_EQ(wedges.Cut, 4 * 0.5);
  EXPECT_DOUBLE_EQ(wedges.Fill, 4 * 4.5);
  EXPECT_EQ(wedges.Area, 16);
}

TEST(CutFill, OfASurfaceWithItselfIsZero)
{
  const ValuedMesh mesh = hills(500, 3);
  const CutFill result = comparedSurfaces(mesh, mesh);
  EXPECT_NEAR(result.Cut + result.Fill, 0, 1e-15);
  EXPECT_EQ(result.OnlyFirst, 0);
  EXPECT_EQ(result.OnlySecond, 0);
  EXPECT_EQ(result.CoveredTwice[0] + result.CoveredTwice[1], 0);
}

TEST(CutFill, IsLimitedByBounds)
{
  const CutFill part =
    comparedSurfaces(plane(0, 4, 0), plane(0, 4, -1, 1), Box2{ { 0.5, 1 }, { 2, 3 } });
  EXPECT_DOUBLE_EQ(part.Cut, 2 * 0.125);
  EXPECT_DOUBLE_EQ(part.Fill, 2 * 0.5);
  EXPECT_DOUBLE_EQ(part.Area, 3);
  EXPECT_EQ(part.OnlyFirst, 0);
  EXPECT_EQ(part.OnlySecond, 0);
}

TEST(CutFill, OfBoundsThatTileAddsUp)
{
  const ValuedMesh first = hills(300, 1, true);
  const ValuedMesh second = hills(250, 2, true);
  const CutFill whole = comparedSurfaces(first, second);
  double cut = 0;
  double fill = 0;
  double area = 0;
  for (const double x : { -1.0, 0.3 })
  {
    for (const double y : { -1.0, 0.7 })
    {
      const CutFill part =
        comparedSurfaces(first, second, Box2{ { x, y }, { x < 0 ? 0.3 : 2, y < 0 ? 0.7 : 2 } });
      cut += part.Cut;
      fill += part.Fill;
      area += part.Area;
    }
  }
  EXPECT_NEAR(cut, whole.Cut, 1e-14);
  EXPECT_NEAR(fill, whole.Fill, 1e-14);
  EXPECT_NEAR(area, whole.Area, 1e-14);
}

TEST(CutFill, OfExchangedSurfacesIsExchanged)
{
  const ValuedMesh first = hills(300, 1);
  const ValuedMesh second = hills(250, 2);
  const CutFill there = comparedSurfaces(first, second);
  const CutFill back = comparedSurfaces(second, first);
  EXPECT_NEAR(there.Cut, back.Fill, 1e-14);
  EXPECT_NEAR(there.Fill, back.Cut, 1e-14);
  EXPECT_NEAR(there.OnlyFirst, back.OnlySecond, 1e-14);
  EXPECT_NEAR(there.OnlySecond, back.OnlyFirst, 1e-14);
}

TEST(CutFill, DoesNotDependOnThreads)
{
  const ValuedMesh first = hills(6000, 1, true);
  const ValuedMesh second = hills(5000, 2, true);
  const CutFill one = comparedSurfaces(first, second, {}, 1);
  for (const int threads : { 2, 5 })
  {
    const CutFill several = comparedSurfaces(first, second, {}, threads);
    EXPECT_EQ(one.Cut, several.Cut);
    EXPECT_EQ(one.Fill, several.Fill);
    EXPECT_EQ(one.Area, several.Area);
    EXPECT_EQ(one.OnlyFirst, several.OnlyFirst);
    EXPECT_EQ(one.OnlySecond, several.OnlySecond);
  }
}

TEST(CutFill, OfPartsAddsUp)
{
  const ValuedMesh first = hills(300, 1, true);
  const ValuedMesh second = hills(200, 2, true);
  CutFillSums sums(first.view(), {}, 2);
  for (const std::int64_t begin : { std::int64_t(0), second.cells() / 3 })
  {
    SimplexMesh part = second.view();
    part.Ids = second.Ids.data() + 3 * begin;
    part.Cells = (begin == 0 ? second.cells() / 3 : second.cells()) - begin;
    EXPECT_TRUE(sums.add(part, {}));
  }
  const CutFill whole = comparedSurfaces(first, second);
  EXPECT_NEAR(sums.result().Cut, whole.Cut, 1e-14);
  EXPECT_NEAR(sums.result().Fill, whole.Fill, 1e-14);
  EXPECT_EQ(sums.result().OnlySecond, 0);
}

TEST(CutFill, TellsOfTrianglesThatOverlap)
{
  ValuedMesh doubled = plane(0, 4, 1);
  doubled.Ids.insert(doubled.Ids.end(), { 0, 1, 2 });
  doubled.OfCells.push_back(0);
  const ValuedMesh once = plane(0, 4, 0);
  const CutFill second = comparedSurfaces(once, doubled);
  EXPECT_EQ(second.CoveredTwice[0], 1);
  EXPECT_EQ(second.CoveredTwice[1], 0);
  EXPECT_EQ(second.Fill, 24);
  const CutFill first = comparedSurfaces(doubled, once);
  EXPECT_EQ(first.CoveredTwice[0], 0);
  EXPECT_EQ(first.CoveredTwice[1], 1);
}

TEST(CutFill, LeavesOutHiddenTriangles)
{
  const ValuedMesh first = plane(0, 4, 0);
  SimplexMesh view = first.view();
  const unsigned char hidden[2] = { 1, 0 };
  view.Hidden = hidden;
  CutFillSums sums(view, {}, 1);
  EXPECT_TRUE(sums.add(plane(0, 4, 2).view(), {}));
  EXPECT_EQ(sums.result().Fill, 16);
  EXPECT_EQ(sums.result().OnlyFirst, 0);
  EXPECT_EQ(sums.result().OnlySecond, 8);
}

TEST(CutFill, RefusesAVolumeThatIsNoNumber)
{
  const double huge = std::numeric_limits<double>::max();
  const ValuedMesh low = plane(0, 4, -huge);
  const ValuedMesh high = plane(0, 4, huge);
  CutFillSums sums(low.view(), {}, 1);
  EXPECT_TRUE(sums.add(high.view(), {}));
  EXPECT_THROW(sums.result(), std::runtime_error);
}

TEST(CutFill, StopsOnRequest)
{
  const ValuedMesh mesh = hills(20, 1);
  CutFillSums sums(mesh.view(), {}, 1);
  EXPECT_FALSE(sums.add(mesh.view(), [](double) { return false; }));
}
