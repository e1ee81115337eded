// SPDX-License-Identifier: BSD-3-Clause
// Input that is not an array of doubles (x, y): single precision, strides, and a third coordinate.
#include "Comparison.h"

#include <cmath>

namespace
{

using namespace tipp;
using namespace tipp::test;

TEST(PointsView, SinglePrecisionIsTriangulatedLikeDoubles)
{
  const Coordinates xy = makePointSet("uniform", 2000);
  const std::vector<float> floats(xy.begin(), xy.end());
  const Coordinates rounded(floats.begin(), floats.end());
  const Triangulation result = triangulate(PointsView(floats.data(), 2000, 2));
  EXPECT_TRUE(matches(rounded, result, reference(rounded)));
}

template <typename T>
std::vector<T> inThreeDimensions(const Coordinates& xy)
{
  std::vector<T> xyz;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    xyz.insert(xyz.end(), { T(xy[i]), T(xy[i + 1]), T(1000 - double(i)) });
  }
  return xyz;
}

TEST(PointsView, TheThirdCoordinateDoesNotMatter)
{
  const Coordinates xy = makePointSet("kuzmin", 2000);
  const std::vector<double> xyz = inThreeDimensions<double>(xy);
  EXPECT_TRUE(matches(xy, triangulate(PointsView(xyz.data(), 2000, 3)), reference(xy)));
}

TEST(PointsView, SinglePrecisionInThreeDimensionsWithTies)
{
  const Coordinates xy = makePointSet("lattice", 2500);
  const std::vector<float> xyz = inThreeDimensions<float>(xy);
  EXPECT_TRUE(matches(xy, triangulate(PointsView(xyz.data(), 2500, 3)), reference(xy)));
}

TEST(PointsView, AnInvalidThirdCoordinateRejectsNothing)
{
  const Coordinates xy = makePointSet("uniform", 100);
  std::vector<double> xyz = inThreeDimensions<double>(xy);
  xyz[2] = std::nan("");
  EXPECT_TRUE(triangulate(PointsView(xyz.data(), 100, 3)).Rejected.empty());
}

} // namespace
