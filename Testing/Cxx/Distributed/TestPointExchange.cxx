// SPDX-License-Identifier: BSD-3-Clause
// How points get to their owners: PointExchange and the resulting PointLayout.
#include "Distributed/PointExchange.h"

#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace
{

using namespace tipp;

constexpr std::size_t RowSize = 3;

/// The points that one rank starts with, one of which is not finite, and a row of bytes for each.
struct Share
{
  explicit Share(int rank)
  {
    std::mt19937 random(std::uint32_t(rank) + 1);
    std::uniform_real_distribution<double> place(0, 1);
    const int count = rank == 1 ? 0 : 200 + 50 * rank; // rank 1 has no points
    for (int i = 0; i < count; ++i)
    {
      this->Positions.push_back({ place(random), place(random) });
      this->Ids.push_back(1000 * rank + 7 * i);
    }
    if (count > 0)
    {
      this->Positions.front().x = std::nan("");
    }
  }

  std::vector<char> row(std::size_t i) const
  {
    return { char(this->Ids[i] % 100), char(i % 100), 'r' };
  }

  RankPoints points() const
  {
    RankPoints points;
    points.Points = PointsView(
      this->Positions.empty() ? nullptr : &this->Positions.front().x, this->Positions.size(), 2);
    points.GlobalIds = this->Ids.data();
    points.RowSize = RowSize;
    points.PackRow = [this](std::size_t i, char* to)
    {
      const std::vector<char> made = this->row(i);
      std::memcpy(to, made.data(), made.size());
    };
    return points;
  }

  std::vector<Point2> Positions;
  std::vector<PointId> Ids;
};

Tiling leaves()
{
  return Tiling::grid({ 0, 0, 1, 1 }, 4, 3);
}

/// The owner of each leaf: the ranks in turn, and the last rank for the last two leaves.
std::vector<std::int32_t> ownersOf(int ranks)
{
  std::vector<std::int32_t> owners;
  for (PartitionIndex leaf = 0; leaf < leaves().size(); ++leaf)
  {
    owners.push_back(leaf < leaves().size() - 2 ? leaf % ranks : ranks - 1);
  }
  return owners;
}

class PointExchangeOf : public testing::TestWithParam<int>
{
};

TEST_P(PointExchangeOf, OwnersGetAllRanksPointsLeafByLeafInTheOrderOfRanks)
{
  Communicator box(vtkMultiProcessController::GetGlobalController());
  const Tiling tiling = leaves();
  const std::vector<std::int32_t> owners = ownersOf(box.size());
  const Share mine(box.rank());
  const RankPoints points = mine.points();
  OwnedPoints<std::int32_t> owned =
    PointExchange(points, tiling, GetParam()).exchange<std::int32_t>(box, owners);

  std::size_t at = 0;
  for (PartitionIndex leaf = 0; leaf < tiling.size(); ++leaf)
  {
    ASSERT_EQ(at, owned.Buckets.start(leaf));
    for (int rank = 0; owners[std::size_t(leaf)] == box.rank() && rank < box.size(); ++rank)
    {
      const Share share(rank);
      for (std::size_t i = 0; i < share.Positions.size(); ++i)
      {
        if (isFinite(share.Positions[i]) && tiling.locate(share.Positions[i]) == leaf)
        {
          ASSERT_LT(at, owned.size());
          EXPECT_EQ(share.Positions[i], owned.Positions[at]);
          EXPECT_EQ(share.Ids[i], owned.GlobalIds[at]);
          const char* const row = owned.Rows.data() + at * RowSize;
          EXPECT_EQ(share.row(i), std::vector<char>(row, row + RowSize));
          ++at;
        }
      }
    }
  }
  EXPECT_EQ(at, owned.size());
  EXPECT_EQ(std::int64_t(at),
    owned.FirstIds[std::size_t(box.rank()) + 1] - owned.FirstIds[std::size_t(box.rank())]);
  box.barrier();
}

INSTANTIATE_TEST_SUITE_P(Threads, PointExchangeOf, testing::Values(1, 3));

TEST(PointReceiver, RefusesAnotherNumberOfPointsThanAnnounced)
{
  Communicator box(vtkMultiProcessController::GetGlobalController());
  const std::vector<std::int32_t> owners(1, 0);
  const PointLayout layout(box, owners, { 2 });
  if (box.rank() == 0)
  {
    PointTuplesOf<Point2> points;
    points.Positions = Buffer<Point2>(std::size_t(2 * box.size()));
    points.GlobalIds = Buffer<PointId>(points.size());
    const Bytes message(PointArrays<Point2>::bytes(3, 0));
    PointReceiver landing(layout, 0, points, 0);
    landing.take(message.data(), PointArrays<Point2>::bytes(2, 0) - 1);
    EXPECT_THROW(landing.requireComplete(), std::runtime_error);
    landing.take(message.data(), 1);
    EXPECT_NO_THROW(landing.requireComplete());
    EXPECT_THROW(landing.take(message.data(), 1), std::runtime_error);
  }
  box.barrier();
}

} // namespace
