// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PointsView.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace
{

using namespace tipp;

const double Doubles[] = { 1, 2, 3, 4, 5, 6, 7, 8, 9 };
const float Floats[] = { 1.5F, 2.5F, 3.5F, 4.5F };

std::vector<std::pair<std::size_t, Point2>> visited(
  PointsView view, std::size_t begin, std::size_t end)
{
  std::vector<std::pair<std::size_t, Point2>> all;
  view.forEach(begin, end, [&](std::size_t i, Point2 p) { all.emplace_back(i, p); });
  return all;
}

TEST(PointsView, TakesTheFirstTwoOfEveryStride)
{
  const PointsView view(Doubles, 3, 3);
  EXPECT_EQ((Point2{ 1, 2 }), view[0]);
  EXPECT_EQ((Point2{ 4, 5 }), view[1]);
  EXPECT_EQ((Point2{ 7, 8 }), view[2]);
}

TEST(PointsView, ReadsFloats)
{
  const PointsView view(Floats, 2, 2);
  EXPECT_EQ(2U, view.size());
  EXPECT_EQ((Point2{ 3.5, 4.5 }), view[1]);
}

TEST(PointsView, VisitsARangeInOrder)
{
  const auto all = visited(PointsView(Doubles, 3, 3), 1, 3);
  ASSERT_EQ(2U, all.size());
  EXPECT_EQ(1U, all[0].first);
  EXPECT_EQ((Point2{ 4, 5 }), all[0].second);
  EXPECT_EQ(2U, all[1].first);
  EXPECT_EQ((Point2{ 7, 8 }), all[1].second);
}

TEST(PointsView, VisitingGivesWhatAccessGives)
{
  for (const PointsView& view : { PointsView(Doubles, 4, 2), PointsView(Floats, 2, 2).scaled(8) })
  {
    for (const auto& [i, p] : visited(view, 0, view.size()))
    {
      EXPECT_EQ(view[i], p);
    }
  }
}

TEST(PointsView, ScalesCoordinates)
{
  const PointsView view = PointsView(Doubles, 3, 3).scaled(4);
  EXPECT_EQ((Point2{ 4, 8 }), view[0]);
  EXPECT_EQ(4, view.factor());
}

TEST(PointsView, FactorsMultiply)
{
  EXPECT_EQ((Point2{ 12, 24 }), PointsView(Doubles, 3, 3).scaled(4).scaled(3)[0]);
}

TEST(PointsView, ScalesFloatsBeyondTheirRange)
{
  const PointsView view = PointsView(Floats, 2, 2).scaled(0x1p900);
  EXPECT_EQ(1.5 * 0x1p900, view[0].x);
}

TEST(PointsView, AViewOfNothingIsEmpty)
{
  EXPECT_EQ(0U, PointsView().size());
  EXPECT_TRUE(visited(PointsView(), 0, 0).empty());
}

} // namespace
