// SPDX-License-Identifier: BSD-3-Clause
#include "CommunicatorTesting.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

TEST(CommunicatorCollectives, AllToAllSendsEachRankItsOwnPart)
{
  Communicator box(controller());
  std::vector<Bytes> contents;
  for (int to = 0; to < box.size(); ++to)
  {
    contents.push_back(filled(std::size_t(100 * box.rank() + to), char(to)));
  }
  const std::vector<Bytes> received = box.allToAll(std::move(contents));
  ASSERT_EQ(received.size(), std::size_t(box.size()));
  for (int from = 0; from < box.size(); ++from)
  {
    const Bytes& bytes = received[std::size_t(from)];
    ASSERT_EQ(bytes.size(), std::size_t(100 * from + box.rank()));
    EXPECT_TRUE(bytes.empty() || bytes[0] == char(box.rank()));
  }
  box.barrier();
}

/// A buffer with a range of bytes for each other rank, and gaps between them. The bytes are the
/// sender's rank.
struct InOneMemory
{
  InOneMemory(const Communicator& box, std::size_t size)
    : Memory(std::size_t(box.size()) * (size + 8))
  {
    for (int to = 0; to < box.size(); ++to)
    {
      this->Contents.push_back({ std::size_t(to) * (size + 8), to == box.rank() ? 0 : size });
    }
    std::fill(this->Memory.begin(), this->Memory.end(), char(box.rank()));
  }

  Bytes Memory;
  std::vector<Communicator::ByteRange> Contents;
};

TEST(CommunicatorCollectives, AllToAllInPartsDeliversAllPartsAndReturnsTheMemory)
{
  Communicator box(controller());
  for (const std::size_t size : { 0, 5, 70'000, 3'000'001 })
  {
    InOneMemory sent(box, size);
    const char* const memory = sent.Memory.data();
    std::vector<std::size_t> got(std::size_t(box.size()), 0);
    sent.Memory = box.allToAllInParts(std::move(sent.Memory), sent.Contents,
      [&](int from, const char* part, std::size_t bytes)
      {
        got[std::size_t(from)] += bytes;
        EXPECT_EQ(std::count(part, part + bytes, char(from)), std::ptrdiff_t(bytes));
      });
    EXPECT_EQ(sent.Memory.data(), memory);
    for (int from = 0; from < box.size(); ++from)
    {
      EXPECT_EQ(got[std::size_t(from)], from == box.rank() ? 0 : size);
    }
  }
  box.barrier();
}

TEST(CommunicatorCollectives, PartsForASlowRankAreNotLost)
{
  Communicator box(controller());
  constexpr std::size_t size = 200'000;
  for (int i = 0; box.rank() == 0 && i < 100; ++i)
  {
    Message message;
    EXPECT_FALSE(box.poll(message)); // receives what other ranks have sent
    box.pause();
  }
  InOneMemory sent(box, size);
  std::vector<std::size_t> got(std::size_t(box.size()), 0);
  box.allToAllInParts(std::move(sent.Memory), sent.Contents,
    [&got](int from, const char*, std::size_t bytes) { got[std::size_t(from)] += bytes; });
  for (int from = 0; from < box.size(); ++from)
  {
    EXPECT_EQ(got[std::size_t(from)], from == box.rank() ? 0 : size);
  }
  box.barrier();
}

TEST(CommunicatorCollectives, AFailingReceiverEndsAllRanks)
{
  constexpr std::size_t size = 5'000'000;
  for (int run = 0; run < 2; ++run)
  {
    Communicator box(controller());
    const auto work = [&]()
    {
      InOneMemory sent(box, size);
      box.allToAllInParts(std::move(sent.Memory), sent.Contents,
        [&box](int from, const char*, std::size_t)
        {
          if (from == (box.rank() + 1) % box.size())
          {
            throw std::runtime_error("no place");
          }
        });
    };
    if (box.size() > 1)
    {
      EXPECT_THROW(box.together(work), RankFailure);
    }
  }
}

TEST(CommunicatorCollectives, GatherIsOrderedByRank)
{
  Communicator box(controller());
  const std::vector<Bytes> all = box.gather(filled(std::size_t(box.rank()) + 1, 'g'));
  ASSERT_EQ(all.size(), box.rank() == 0 ? std::size_t(box.size()) : 0u);
  for (std::size_t from = 0; from < all.size(); ++from)
  {
    EXPECT_EQ(all[from].size(), from + 1);
  }
  box.barrier();
}

TEST(CommunicatorCollectives, BroadcastAndSumReachEveryRank)
{
  Communicator box(controller());
  for (std::size_t size : { 0, 1, 100000 })
  {
    const Bytes got = box.broadcast(box.rank() == 0 ? filled(size, 'q') : Bytes());
    ASSERT_EQ(got.size(), size);
  }
  std::vector<std::int64_t> values = { 1, box.rank() };
  box.sum(values);
  EXPECT_EQ(values[0], box.size());
  EXPECT_EQ(values[1], box.size() * (box.size() - 1) / 2);
}

} // namespace
