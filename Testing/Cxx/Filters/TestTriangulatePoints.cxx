// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/ResolveCrossings.h"
#include "InMemory/TriangulatePoints.h"

#include "Constraints/SurfaceValues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{

using namespace tipp;

/// A square of side 4, and a square of side 2 in its middle. Both are counter-clockwise.
const std::vector<double> squares{ 0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 1, 3, 3, 1, 3 };

PointsView viewOf(const std::vector<double>& xy)
{
  return { xy.data(), xy.size() / 2, 2 };
}

/// The inner square as a polygon, which is cell 7 of its source.
SourceConstraints innerSquare()
{
  return { { { 4, 5 }, { 5, 6 }, { 6, 7 }, { 7, 4 } }, { 7, 7, 7, 7 }, 0 };
}

std::string messageOf(const std::vector<double>& xy, const SourceConstraints& source)
{
  PointsRequest request;
  request.Source = &source;
  std::vector<std::string> warnings;
  try
  {
    triangulatePoints(viewOf(xy), request, warnings);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(TriangulatePoints, KeepsTheInsideOfPolygons)
{
  const SourceConstraints source = innerSquare();
  PointsRequest request;
  request.Source = &source;
  std::vector<std::string> warnings;
  EXPECT_EQ(2U, triangulatePoints(viewOf(squares), request, warnings).Mesh.triangleCount());
  EXPECT_TRUE(warnings.empty());
}

TEST(TriangulatePoints, MergesPointsWithinTheDistance)
{
  PointsRequest request;
  request.Distance = 1.5;
  std::vector<std::string> warnings;
  const ConstrainedTriangulation result = triangulatePoints(viewOf(squares), request, warnings);
  EXPECT_EQ(4U, result.Mesh.Duplicates.size());
  const Buffer<std::int64_t> ids = representativeIds(result.Mesh, 8);
  EXPECT_EQ(std::vector<std::int64_t>({ 0, 1, 2, 3, 0, 1, 2, 3 }),
    std::vector<std::int64_t>(ids.begin(), ids.end()));
}

TEST(TriangulatePoints, WarnsAboutPointsThatAreNotFinite)
{
  std::vector<double> xy = squares;
  xy[8] = NAN;
  std::vector<std::string> warnings;
  triangulatePoints(viewOf(xy), {}, warnings);
  ASSERT_EQ(1U, warnings.size());
  EXPECT_EQ("1 of 8 points have a NaN or infinite coordinate and are in no triangle; the first is "
            "point 4.",
    warnings[0]);
}

TEST(TriangulatePoints, RefusesAPolygonWithACornerThatIsNotFinite)
{
  std::vector<double> xy = squares;
  xy[10] = INFINITY;
  EXPECT_EQ("cell 7 of the source, a polygon, has the corner 5, which is NaN or infinite: remove "
            "the polygon or correct the point.",
    messageOf(xy, innerSquare()));
}

TEST(TriangulatePoints, RequiresIdsOfPoints)
{
  EXPECT_NO_THROW(requireIds(innerSquare(), 8));
  EXPECT_THROW(requireIds(innerSquare(), 7), std::runtime_error);
}

TEST(TriangulatePoints, MarksTheEdgesOfConstraints)
{
  const SourceConstraints source = innerSquare();
  PointsRequest request;
  request.Source = &source;
  std::vector<std::string> warnings;
  const ConstrainedTriangulation result = triangulatePoints(viewOf(squares), request, warnings);
  const Buffer<unsigned char> marks = constraintMarks(result.Mesh, result.Constraints.Segments);
  EXPECT_EQ(4, std::count(marks.begin(), marks.end(), 1)); // all edges except the diagonal
  const Buffer<std::int64_t> neighbors = neighborIds(result.Mesh);
  for (std::size_t i = 0; i < marks.size(); ++i)
  {
    EXPECT_EQ(marks[i] == 1, neighbors[i] < 0);
  }
}

TEST(InterpolateTuples, FollowsTheEdgeAndRoundsIntegers)
{
  const std::vector<CrossingPoint> crossings{ { {}, 0, 1, 0.25 }, { {}, 2, 1, 0.5 } };
  std::vector<double> doubles{ 1, 3, 0, 0 };
  interpolateTuples(crossings, 2, Scalar::Float64, 1, doubles.data());
  EXPECT_EQ(std::vector<double>({ 1, 3, 1.5, 2.25 }), doubles);
  std::vector<std::int32_t> integers{ -1, -3, 0, 0 };
  interpolateTuples(crossings, 2, Scalar::Int32, 1, integers.data());
  EXPECT_EQ(std::vector<std::int32_t>({ -1, -3, -2, -3 }), integers);
}
