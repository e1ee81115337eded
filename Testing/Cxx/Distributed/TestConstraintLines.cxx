// SPDX-License-Identifier: BSD-3-Clause
// The edges on constraints, of which each rank lists its own.
#include "DistributedTesting.h"

#include "Distributed/ConstrainRanks.h"
#include "Distributed/DistributedTriangulation.h"

#include <vtkMultiProcessController.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// A lattice of 20 x 20 points with spacing 1, distributed over all ranks, with constraints.
class ConstraintLinesOnRanks : public testing::Test
{
protected:
  static constexpr int Side = 20;

  static ConstraintSegment segment(Point2 a, Point2 b) { return { a, b, SegmentRole::Line }; }

  /// Triangulates with the given segments, whose source cells are 100, 101, ...
  ConstraintLines find(const std::vector<ConstraintSegment>& given)
  {
    for (int i = 0; i < Side * Side; ++i)
    {
      this->XY.insert(this->XY.end(), { double(i % Side), double(i / Side) });
    }
    std::vector<std::int64_t> order;
    const ConstraintSegments segments(given, &order);
    std::vector<std::int64_t> cells;
    for (std::size_t i = 0; i < given.size(); ++i)
    {
      cells.push_back(100 + std::int64_t(i));
    }
    const RankShare mine = shareOf(this->XY, Share::RoundRobin, this->Box.rank(), this->Box.size());
    RankPoints points;
    points.Points = PointsView(mine.XY.data(), mine.GlobalIds.size(), 2);
    points.GlobalIds = mine.GlobalIds.data();
    DistributedOptions options;
    options.Threads = 1;
    options.Minor = { 4, 4 };
    options.MinorDivision = Division::Grid;
    this->Result = triangulateDistributed(this->Box, points, options);
    ConstraintLines lines;
    this->Box.together(
      [&]
      {
        constrainRanks(this->Box, segments, 1, this->Result);
        lines = findConstraintLines(this->Box, { segments, order, cells }, this->Result);
      });
    return lines;
  }

  std::int64_t idOf(std::int64_t local) const
  {
    const auto own = std::int64_t(this->Result.Owned.size());
    return local < own ? this->Result.Owned.GlobalIds[std::size_t(local)]
                       : this->Result.Ghosts.GlobalIds[std::size_t(local - own)];
  }

  /// This rank's triangle edges, directed so that the triangle is on their left.
  std::set<std::array<std::int64_t, 2>> edges() const
  {
    std::set<std::array<std::int64_t, 2>> edges;
    const Buffer<std::int32_t>& ids = this->Result.Ids32;
    for (std::size_t c = 0; c < ids.size(); ++c)
    {
      edges.insert({ this->idOf(ids[c]), this->idOf(ids[c % 3 == 2 ? c - 2 : c + 1]) });
    }
    return edges;
  }

  Communicator Box{ vtkMultiProcessController::GetGlobalController() };
  Coordinates XY;
  DistributedTriangulation Result;
};

TEST_F(ConstraintLinesOnRanks, ListEachEdgeOnceForEachConstraintOnIt)
{
  // The second segment overlaps the first in the opposite direction. The third is on the hull, with
  // triangles only on its right. The last is a single long edge.
  const ConstraintLines mine = this->find({ segment({ 2, 3 }, { 12, 3 }),
    segment({ 9, 3 }, { 5, 3 }), segment({ 0, 4 }, { 0, 9 }), segment({ 1, 15 }, { 18, 16 }) });
  const std::set<std::array<std::int64_t, 2>> edges = this->edges();
  std::vector<std::vector<std::int64_t>> rows; // cell, both ends, 1 if a triangle is on the left
  ASSERT_EQ(mine.Ends.size(), mine.Cells.size());
  for (std::size_t i = 0; i < mine.Ends.size(); ++i)
  {
    const std::int64_t a = this->idOf(mine.Ends[i][0]);
    const std::int64_t b = this->idOf(mine.Ends[i][1]);
    EXPECT_TRUE(edges.count({ a, b }) + edges.count({ b, a }) > 0) << "no triangle of " << a;
    rows.push_back({ mine.Cells[i], a, b, edges.count({ a, b }) > 0 ? 1 : 0 });
  }
  const auto firsts = this->Box.allGather(std::vector<std::int64_t>{ mine.First });
  std::vector<std::vector<std::int64_t>> all;
  std::size_t rank = 0;
  for (const auto& part : this->Box.allGather(rows))
  {
    EXPECT_EQ(std::int64_t(all.size()), firsts[rank++][0]);
    EXPECT_TRUE(std::is_sorted(
      part.begin(), part.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; }))
      << "by constraint";
    all.insert(all.end(), part.begin(), part.end());
  }
  std::sort(all.begin(), all.end());
  std::vector<std::vector<std::int64_t>> expected;
  const auto id = [](int x, int y) { return std::int64_t(y * Side + x); };
  for (int x = 2; x < 12; ++x)
  {
    expected.push_back({ 100, id(x, 3), id(x + 1, 3), 1 });
  }
  for (int x = 5; x < 9; ++x)
  {
    expected.push_back({ 101, id(x + 1, 3), id(x, 3), 1 });
  }
  for (int y = 4; y < 9; ++y)
  {
    expected.push_back({ 102, id(0, y), id(0, y + 1), 0 });
  }
  expected.push_back({ 103, id(1, 15), id(18, 16), 1 });
  EXPECT_EQ(expected, all);
}

TEST_F(ConstraintLinesOnRanks, AreNoneWithoutConstraints)
{
  const ConstraintLines mine = this->find({});
  EXPECT_TRUE(mine.Ends.empty());
  EXPECT_TRUE(mine.Cells.empty());
  EXPECT_EQ(0, mine.First);
}

} // namespace
