// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/ArrayFiles.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace
{

using Groups = std::vector<std::size_t>;

/// Two arrays whose tuples hold their own id: one of 4 and one of 3 bytes per tuple. A group is a
/// range of `inGroup` tuples, and the buffers hold one group at a time.
class GroupSource
{
public:
  GroupSource(std::size_t groups, std::size_t inGroup)
    : InGroup(inGroup)
    , Path(this->Folder.file("bytes", std::string(8 * groups * inGroup, ' ')))
    , Files({ { "number", this->Path, 0, tipp::Scalar::UInt32, 1, std::int64_t(groups * inGroup) },
        { "bytes", this->Path, 0, tipp::Scalar::UInt8, 3, std::int64_t(groups * inGroup) } })
  {
    this->Buffers.resize(this->Files, std::int64_t(inGroup));
  }

  void hold(std::size_t group)
  {
    for (std::size_t i = 0; i < this->InGroup; ++i)
    {
      const auto id = std::uint32_t(group * this->InGroup + i);
      std::memcpy(this->Buffers.data(0) + 4 * i, &id, 4);
      std::memcpy(this->Buffers.data(1) + 3 * i, &id, 3);
    }
  }

  std::size_t InGroup;
  tipp::test::TemporaryFolder Folder;
  std::string Path;
  tipp::ArrayFiles Files;
  tipp::TupleBuffers Buffers;
};

/// Gathers the tuples of these ids, in the order of groups that `arrange` makes, and compares each
/// tuple with its id.
template <typename Arrange>
void expectMoved(GroupSource& source, const std::vector<std::uint32_t>& ids, std::size_t groups,
  int threads, const Arrange& arrange)
{
  tipp::GroupedMoves moves;
  moves.sort(ids.size(), groups, threads,
    [&](std::size_t i)
    { return std::make_pair(ids[i] / source.InGroup, std::uint32_t(ids[i] % source.InGroup)); });
  Groups order = moves.wanted();
  arrange(order);
  std::vector<std::uint32_t> numbers(ids.size(), 0);
  std::vector<char> bytes(3 * ids.size(), 0);
  void* const out[] = { numbers.data(), bytes.data() };
  for (const std::size_t group : order)
  {
    source.hold(group);
    moves.gather(group, group == order.back(), source.Files, source.Buffers, out, threads);
  }
  EXPECT_EQ(ids, numbers);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    ASSERT_EQ(0, std::memcmp(&bytes[3 * i], &ids[i], 3)) << i;
  }
}

void leave(Groups&) {}

std::vector<std::uint32_t> randomIds(std::size_t count, std::size_t below)
{
  std::mt19937_64 random(7);
  std::vector<std::uint32_t> ids(count);
  std::generate(ids.begin(), ids.end(), [&] { return std::uint32_t(random() % below); });
  return ids;
}

} // namespace

TEST(GroupedMoves, CopyTuplesToEveryPositionThatNeedsThem)
{
  GroupSource source(5, 300);
  for (const std::size_t count : { 1, 8191, 8192, 8193, 50000 })
  {
    expectMoved(source, randomIds(count, 5 * 300), 5, 3, leave);
  }
}

TEST(GroupedMoves, AcceptGroupsInAnyOrder)
{
  GroupSource source(9, 100);
  expectMoved(source, randomIds(30000, 9 * 100), 9, 2,
    [](Groups& groups) { std::reverse(groups.begin(), groups.end()); });
}

TEST(GroupedMoves, KeepTheOrderOfIdsInOneGroup)
{
  GroupSource source(4, 10000);
  std::vector<std::uint32_t> ids(40000);
  std::iota(ids.begin(), ids.end(), 0U);
  expectMoved(source, ids, 4, 2, leave);
}

TEST(GroupedMoves, SortIntoMoreGroupsThanABlockOfShortPositionsHolds)
{
  GroupSource source(6000, 2);
  expectMoved(source, randomIds(200000, 6000 * 2), 6000, 3, leave);
}

TEST(GroupedMoves, ListTheGroupsThatAreNeeded)
{
  tipp::GroupedMoves moves;
  const std::vector<std::size_t> groupOf{ 7, 2, 7, 4 };
  moves.sort(4, 9, 1, [&](std::size_t i) { return std::make_pair(groupOf[i], 0U); });
  EXPECT_EQ((Groups{ 2, 4, 7 }), moves.wanted());
}
