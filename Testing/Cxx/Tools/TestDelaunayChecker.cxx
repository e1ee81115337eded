// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"
#include "Arrays/FindNeighbors.h"
#include "Check/DelaunayChecker.h"
#include "Distributions/GeneratePoints.h"
#include "SharedData.h"
#include "Triangulation/Triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace
{

using tipp::checkDelaunay;
using tipp::CheckOptions;
using tipp::CheckReport;
using Ids = std::vector<std::int64_t>;
using Coordinates = std::vector<double>;

Ids triangulate(const Coordinates& xy)
{
  const tipp::Triangulation result =
    tipp::triangulate(tipp::PointsView(xy.data(), xy.size() / 2, 2));
  return { result.Ids32.begin(), result.Ids32.end() };
}

// Options under which every error is reported.
CheckOptions strict()
{
  CheckOptions options;
  options.TieRule = true;
  return options;
}

CheckOptions boundaryFree()
{
  CheckOptions options;
  options.BoundaryFree = true;
  return options;
}

// A correct triangulation, into which tests insert errors.
class Spoiled : public testing::Test
{
protected:
  Spoiled()
    : XY(tipp::generatePoints(tipp::Distribution::Uniform, 500, 11))
    , Triangles(triangulate(this->XY))
  {
  }

  CheckReport check(const CheckOptions& options = {}) const
  {
    return checkDelaunay(this->XY, this->Triangles, options);
  }

  // The corner opposite the edge a -> b, or -1.
  std::int64_t apex(std::int64_t a, std::int64_t b) const
  {
    for (std::size_t h = 0; h < this->Triangles.size(); ++h)
    {
      const std::size_t start = h / 3 * 3;
      if (this->Triangles[h] == a && this->Triangles[start + (h + 1) % 3] == b)
      {
        return this->Triangles[start + (h + 2) % 3];
      }
    }
    return -1;
  }

  bool turnsLeft(std::int64_t a, std::int64_t b, std::int64_t c) const
  {
    const double* const p = this->XY.data();
    return (p[2 * b] - p[2 * a]) * (p[2 * c + 1] - p[2 * a + 1]) >
      (p[2 * b + 1] - p[2 * a + 1]) * (p[2 * c] - p[2 * a]);
  }

  void replace(std::int64_t a, std::int64_t b, std::int64_t c, const Ids& by)
  {
    for (std::size_t t = 0; t < this->Triangles.size(); t += 3)
    {
      const auto first = this->Triangles.begin() + std::ptrdiff_t(t);
      Ids sorted(first, first + 3);
      Ids wanted{ a, b, c };
      std::sort(sorted.begin(), sorted.end());
      std::sort(wanted.begin(), wanted.end());
      if (sorted == wanted)
      {
        std::copy(by.begin(), by.end(), first);
        return;
      }
    }
    FAIL() << "no such triangle";
  }

  // Flips the first edge whose two triangles form a convex quadrilateral.
  void flipAnEdge()
  {
    for (std::size_t t = 0; t < this->Triangles.size(); t += 3)
    {
      const std::int64_t a = this->Triangles[t];
      const std::int64_t b = this->Triangles[t + 1];
      const std::int64_t c = this->Triangles[t + 2];
      const std::int64_t d = this->apex(b, a);
      if (d >= 0 && this->turnsLeft(d, b, c) && this->turnsLeft(d, c, a))
      {
        this->replace(a, b, c, { d, b, c });
        this->replace(a, b, d, { d, c, a });
        return;
      }
    }
    FAIL() << "no edge to flip";
  }

  // The first triangle with an edge on the hull, or the first without.
  std::size_t findTriangle(bool onHull) const
  {
    for (std::size_t t = 0; t < this->Triangles.size(); t += 3)
    {
      bool boundary = false;
      for (std::size_t k = 0; k < 3; ++k)
      {
        boundary =
          boundary || this->apex(this->Triangles[t + (k + 1) % 3], this->Triangles[t + k]) < 0;
      }
      if (boundary == onHull)
      {
        return t;
      }
    }
    throw std::logic_error("no such triangle");
  }

  void drop(std::size_t triangle)
  {
    const auto first = this->Triangles.begin() + std::ptrdiff_t(triangle);
    this->Triangles.erase(first, first + 3);
  }

  Coordinates XY;
  Ids Triangles;
};

const Coordinates square{ 0, 0, 1, 0, 0, 1, 1, 1 };

class CorrectTriangulation : public testing::TestWithParam<std::string>
{
};

} // namespace

TEST_P(CorrectTriangulation, HasNoFault)
{
  const Coordinates xy = tipp::generatePoints(*tipp::distributionFromName(GetParam()), 3000, 5);
  const CheckReport report = checkDelaunay(xy, triangulate(xy), strict());
  EXPECT_TRUE(report.isCorrect()) << testing::PrintToString(report.faults());
  EXPECT_EQ(3000, report.Points);
}

INSTANTIATE_TEST_SUITE_P(DelaunayChecker, CorrectTriangulation,
  testing::ValuesIn(tipp::distributionNames()), [](const auto& info) { return info.param; });

TEST_F(Spoiled, WrongNeighborIsFound)
{
  Ids neighbors(this->Triangles.size());
  tipp::findNeighbors(this->Triangles.data(), this->Triangles.size() / 3, neighbors.data());
  const auto bad = [&]
  { return checkDelaunay(this->XY, this->Triangles, strict(), neighbors).BadNeighbors; };
  EXPECT_EQ(0, bad());
  for (std::size_t i = 0; i < neighbors.size(); i += 7)
  {
    const std::int64_t right = neighbors[i];
    neighbors[i] = right == -1 ? 3 : -1;
    EXPECT_EQ(1, bad()) << i;
    neighbors[i] = right;
  }
  std::swap(neighbors[0], neighbors[1]);
  EXPECT_EQ(2, bad());
}

TEST_F(Spoiled, HasNoErrorIfUnchanged)
{
  const CheckReport report = this->check(strict());
  EXPECT_TRUE(report.isCorrect()) << testing::PrintToString(report.faults());
  EXPECT_EQ(500, report.DistinctPoints);
  EXPECT_EQ(0, report.Ties);
}

TEST_F(Spoiled, FlippedEdgeIsNotDelaunay)
{
  this->flipAnEdge();
  const CheckReport report = this->check();
  EXPECT_GE(report.BadSpheres, 1);
  EXPECT_EQ(0, report.BadTurns + report.BadFacets + report.BadHullEdges + report.EulerMismatch);
}

TEST_F(Spoiled, DroppedInnerTriangleLeavesAHole)
{
  this->drop(this->findTriangle(false));
  const CheckReport report = this->check();
  EXPECT_GT(report.BadHullEdges, 0);
  EXPECT_NE(0, report.EulerMismatch);
}

TEST_F(Spoiled, DroppedTriangleAtTheHullLeavesADent)
{
  this->drop(this->findTriangle(true));
  EXPECT_GT(this->check().BadHullEdges, 0);
}

TEST_F(Spoiled, FreeBoundaryMayHaveADent)
{
  this->drop(this->findTriangle(true));
  EXPECT_TRUE(this->check(boundaryFree()).isCorrect());
}

TEST_F(Spoiled, FreeBoundaryDoesNotExcuseAFlippedEdge)
{
  this->flipAnEdge();
  EXPECT_GE(this->check(boundaryFree()).BadSpheres, 1);
}

TEST_F(Spoiled, ReversedTriangleIsClockwise)
{
  std::swap(this->Triangles[0], this->Triangles[1]);
  const CheckReport report = this->check();
  EXPECT_EQ(1, report.BadTurns);
  EXPECT_GT(report.BadFacets, 0);
}

TEST_F(Spoiled, AllTrianglesReversedAreClockwise)
{
  for (std::size_t t = 0; t < this->Triangles.size(); t += 3)
  {
    std::swap(this->Triangles[t], this->Triangles[t + 1]);
  }
  EXPECT_EQ(std::int64_t(this->Triangles.size() / 3), this->check().BadTurns);
}

TEST_F(Spoiled, DoubledTriangleSharesItsEdges)
{
  const std::size_t inner = this->findTriangle(false);
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->Triangles.push_back(this->Triangles[inner + k]);
  }
  const CheckReport report = this->check();
  EXPECT_EQ(3, report.BadFacets);
  EXPECT_EQ(1, report.EulerMismatch);
}

TEST_F(Spoiled, PointInNoTriangleIsMissed)
{
  this->XY.insert(this->XY.end(), { 0.5, 0.5 });
  const CheckReport report = this->check();
  EXPECT_EQ(1, report.UnusedPoints);
  EXPECT_EQ(-2, report.EulerMismatch);
}

TEST_F(Spoiled, PointOutsideTheHullIsMissed)
{
  this->XY.insert(this->XY.end(), { 5, 5 });
  EXPECT_EQ(1, this->check().UnusedPoints);
}

TEST_F(Spoiled, DuplicateOfAVertexIsNotMissed)
{
  this->XY.insert(this->XY.end(), { this->XY[0], this->XY[1] });
  const CheckReport report = this->check();
  EXPECT_TRUE(report.isCorrect());
  EXPECT_EQ(501, report.Points);
  EXPECT_EQ(500, report.DistinctPoints);
}

TEST_F(Spoiled, EqualVerticesWithTwoIdsAreTwins)
{
  this->XY.insert(this->XY.end(), { this->XY[0], this->XY[1] });
  *std::find(this->Triangles.begin(), this->Triangles.end(), 0) = 500;
  EXPECT_EQ(1, this->check().TwinVertices);
}

TEST_F(Spoiled, PointsThatAreNotFiniteNeedNoTriangle)
{
  this->XY.insert(
    this->XY.end(), { std::nan(""), 0.5, 0.5, std::numeric_limits<double>::infinity() });
  EXPECT_TRUE(this->check().isCorrect());
}

TEST_F(Spoiled, InvalidPointIdsAreReported)
{
  this->XY.insert(this->XY.end(), { std::nan(""), 0.5 });
  for (const std::int64_t id : { std::int64_t(-1), std::int64_t(501), std::int64_t(500),
         std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min() })
  {
    const std::int64_t before = this->Triangles[4];
    this->Triangles[4] = id;
    EXPECT_EQ(1, this->check().BadIds) << id;
    this->Triangles[4] = before;
  }
}

TEST_F(Spoiled, ClosedCornerIsFlat)
{
  this->Triangles[1] = this->Triangles[0];
  EXPECT_EQ(1, this->check().BadTurns);
}

TEST_F(Spoiled, EveryErrorIsReported)
{
  CheckReport report;
  EXPECT_TRUE(report.faults().empty());
  report.BadTurns = 3;
  report.EulerMismatch = -2;
  EXPECT_EQ((std::vector<std::string>{ "3 triangles are clockwise or flat",
              "-2 more triangles (negative: fewer) than Euler's formula gives" }),
    report.faults());
}

TEST(DelaunayChecker, TiesMayBeBrokenEitherWayUnlessTheRuleIsRequired)
{
  const Ids byRule{ 0, 1, 2, 1, 3, 2 };
  const Ids againstRule{ 0, 1, 3, 0, 3, 2 };
  EXPECT_TRUE(checkDelaunay(square, byRule).isCorrect());
  EXPECT_TRUE(checkDelaunay(square, againstRule).isCorrect());
  EXPECT_TRUE(checkDelaunay(square, byRule, strict()).isCorrect());
  EXPECT_EQ(1, checkDelaunay(square, againstRule, strict()).BadTies);
  EXPECT_EQ(1, checkDelaunay(square, againstRule).Ties);
}

TEST(DelaunayChecker, UlpDecidesBetweenTheDiagonals)
{
  const double inside = std::nextafter(1, 0);
  const double outside = std::nextafter(1, 2);
  const Ids throughOrigin{ 0, 1, 3, 0, 3, 2 };
  const Ids besideOrigin{ 0, 1, 2, 1, 3, 2 };
  const Coordinates near{ 0, 0, 1, 0, 0, 1, inside, inside };
  const Coordinates far{ 0, 0, 1, 0, 0, 1, outside, outside };
  EXPECT_TRUE(checkDelaunay(near, throughOrigin).isCorrect());
  EXPECT_EQ(1, checkDelaunay(near, besideOrigin).BadSpheres);
  EXPECT_TRUE(checkDelaunay(far, besideOrigin).isCorrect());
  EXPECT_EQ(1, checkDelaunay(far, throughOrigin).BadSpheres);
}

TEST(DelaunayChecker, CoordinatesMayBeVerySmallOrLarge)
{
  for (const double scale : { 1e-300, 1e150 })
  {
    Coordinates xy = tipp::generatePoints(tipp::Distribution::Lattice, 100, 0);
    for (double& value : xy)
    {
      value *= scale;
    }
    EXPECT_TRUE(checkDelaunay(xy, triangulate(xy), strict()).isCorrect()) << scale;
  }
}

TEST(DelaunayChecker, CollinearPointsNeedNoTriangles)
{
  for (const Coordinates& xy : { Coordinates{}, Coordinates{ 1, 2 }, Coordinates{ 1, 2, 3, 4 },
         Coordinates{ 1, 2, 1, 2, 1, 2 }, Coordinates{ 0, 0, 3, 3, 1, 1, 2, 2 } })
  {
    EXPECT_TRUE(checkDelaunay(xy, {}).isCorrect());
  }
}

TEST(DelaunayChecker, OtherPointsNeedTriangles)
{
  EXPECT_EQ(4, checkDelaunay(square, {}).UnusedPoints);
}

TEST(DelaunayChecker, VerticesOnAStraightHullAreAllowed)
{
  EXPECT_TRUE(checkDelaunay({ 0, 0, 1, 0, 2, 0, 1, 1 }, { 0, 1, 3, 1, 2, 3 }).isCorrect());
}

TEST(DelaunayChecker, TwoSeparateMeshesAreNotOneHull)
{
  const CheckReport report =
    checkDelaunay({ 0, 0, 1, 0, 0, 1, 5, 5, 6, 5, 5, 6 }, { 0, 1, 2, 3, 4, 5 });
  EXPECT_EQ(3, report.BadHullEdges);
}

TEST(DelaunayChecker, FindsTheKnownErrorsOfMeshes)
{
  struct Known
  {
    const char* Name;
    std::int64_t BadSpheres;
  };
  for (const Known& known : { Known{ "adcirc/ec95d/ec95d.grd", 0 },
         Known{ "adcirc/internal_overflow/internal_overflow.grd", 0 },
         Known{ "adcirc/shinnecock/fort.14", 8 }, Known{ "adcirc/apes/fort.14", 235 } })
  {
    TIPP_REQUIRE_DATA(path, known.Name);
    const tipp::AdcircGrid grid = tipp::readAdcircGrid(path);
    const CheckReport report = checkDelaunay(grid.XY, grid.Triangles, boundaryFree());
    EXPECT_EQ(known.BadSpheres, report.BadSpheres) << known.Name;
    EXPECT_EQ(known.BadSpheres > 0 ? 1U : 0U, report.faults().size()) << known.Name;
  }
}
