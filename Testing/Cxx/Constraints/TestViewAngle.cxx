// SPDX-License-Identifier: BSD-3-Clause
// The angles at which vertices see a segment, compared with the in-circle test.
#include "PointSets.h"

#include "Constraints/Insertion/SegmentInserter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace
{

using namespace tipp;

/// How often a comparison of view angles decides. Fails if it does not agree with inCircle().
std::size_t decidedComparisons(const std::vector<Point2>& onLeft, Point2 from, Point2 to)
{
  std::size_t decided = 0;
  for (const Point2 one : onLeft)
  {
    for (const Point2 other : onLeft)
    {
      bool isDecided = true;
      const bool isLarger =
        ViewAngle(from, to, one)
          .isLarger(ViewAngle(from, to, other), [&] { return isDecided = false; });
      if (isDecided)
      {
        ++decided;
        EXPECT_EQ(isLarger ? 1 : -1, inCircle(from, to, other, one));
      }
    }
  }
  return decided;
}

TEST(ViewAngle, AgreesWithTheCircleTestForCoordinatesOfAnyMagnitude)
{
  const test::Coordinates xy = test::makePointSet("uniform", 50);
  for (const double scale : { 1e-200, 1e-150, 1e-81, 1e-75, 1.0, 1e70, 1e80, 1e150, 1e300 })
  {
    std::vector<Point2> onLeft;
    for (std::size_t i = 0; i < xy.size(); i += 2)
    {
      onLeft.push_back({ scale * xy[i], scale * (xy[i + 1] + 0.1) });
    }
    const std::size_t decided = decidedComparisons(onLeft, { 0, 0 }, { scale, 0 });
    EXPECT_TRUE(scale != 1 || decided == 50 * 49) << decided;
  }
}

TEST(ViewAngle, AgreesWithTheCircleTestForPointsNearACircle)
{
  std::vector<Point2> onLeft;
  for (int i = 1; i < 60; ++i)
  {
    constexpr double step = 0.05;
    onLeft.push_back({ 3 + std::cos(i * step), 5 + std::sin(i * step) });
    onLeft.push_back({ std::nextafter(onLeft.back().x, 9), onLeft.back().y });
  }
  decidedComparisons(onLeft, { 2, 5 }, { 4, 5 });
}

} // namespace
