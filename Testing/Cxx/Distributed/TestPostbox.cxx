// SPDX-License-Identifier: BSD-3-Clause
#include "Messages/Postbox.h"

#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

#include <numeric>

namespace
{

using namespace tipp;

constexpr MessageKind Note = MessageKind::FirstFree;

vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}

Bytes filled(std::size_t size, char with)
{
  Bytes bytes(size);
  std::fill(bytes.begin(), bytes.end(), with);
  return bytes;
}

TEST(Postbox, NoControllerIsOneRank)
{
  Postbox box(nullptr);
  EXPECT_EQ(box.size(), 1);
  EXPECT_EQ(box.rank(), 0);
  box.post(0, Note, filled(3, 'a'));
  EXPECT_EQ(box.wait(Note, 0).Content.size(), 3u);
}

TEST(Postbox, MessagesOfARankArriveInOrder)
{
  Postbox box(controller());
  const int next = (box.rank() + 1) % box.size();
  const int previous = (box.rank() + box.size() - 1) % box.size();
  const std::size_t sizes[] = { 0, 10, 300000, 1, 70000, 2 };
  for (const std::size_t size : sizes)
  {
    box.post(next, Note, filled(size, char(size % 100)));
  }
  for (const std::size_t size : sizes)
  {
    const Message message = box.wait(Note, previous);
    ASSERT_EQ(message.Content.size(), size);
    for (const char c : message.Content)
    {
      ASSERT_EQ(c, char(size % 100));
    }
  }
  box.barrier();
}

TEST(Postbox, LargeMessagesCross)
{
  Postbox box(controller());
  constexpr std::size_t size = 20'000'000;
  for (int to = 0; to < box.size(); ++to)
  {
    box.post(to, Note, filled(size, char(box.rank())));
  }
  for (int from = 0; from < box.size(); ++from)
  {
    const Message message = box.wait(Note, from);
    ASSERT_EQ(message.Content.size(), size);
    EXPECT_EQ(message.Content[size - 1], char(from));
  }
  box.flush();
  box.barrier();
}

TEST(Postbox, AllToAllGivesEachRankItsOwn)
{
  Postbox box(controller());
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

/// A stretch for each other rank, of bytes that tell who sent them, and room between them.
struct InOneMemory
{
  InOneMemory(const Postbox& box, std::size_t size)
    : Memory(std::size_t(box.size()) * (size + 8))
  {
    for (int to = 0; to < box.size(); ++to)
    {
      this->Contents.push_back({ std::size_t(to) * (size + 8), to == box.rank() ? 0 : size });
    }
    std::fill(this->Memory.begin(), this->Memory.end(), char(box.rank()));
  }

  Bytes Memory;
  std::vector<Postbox::Stretch> Contents;
};

TEST(Postbox, AllToAllInPartsHandsOnAllAndGivesTheMemoryBack)
{
  Postbox box(controller());
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

TEST(Postbox, PartsThatComeWhileARankIsBehindAreNotLost)
{
  Postbox box(controller());
  constexpr std::size_t size = 200'000;
  for (int i = 0; box.rank() == 0 && i < 100; ++i)
  {
    Message message;
    EXPECT_FALSE(box.poll(message)); // what the others have sent is taken in
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

TEST(Postbox, BroadcastAndSumReachEveryRank)
{
  Postbox box(controller());
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

TEST(Postbox, GatherComesByRank)
{
  Postbox box(controller());
  const std::vector<Bytes> all = box.gather(filled(std::size_t(box.rank()) + 1, 'g'));
  ASSERT_EQ(all.size(), box.rank() == 0 ? std::size_t(box.size()) : 0u);
  for (std::size_t from = 0; from < all.size(); ++from)
  {
    EXPECT_EQ(all[from].size(), from + 1);
  }
  box.barrier();
}

TEST(Postbox, AFailureEndsTheOthersWaiting)
{
  for (int failing = 0; failing < controller()->GetNumberOfProcesses(); ++failing)
  {
    Postbox box(controller());
    try
    {
      box.together(
        [&]()
        {
          if (box.rank() == failing)
          {
            throw std::runtime_error("no more ink");
          }
          box.wait(Note, failing); // which never comes
        });
      FAIL() << "nothing was thrown";
    }
    catch (const RankFailure& failure)
    {
      EXPECT_EQ(failure.Rank, failing);
      EXPECT_STREQ(failure.what(), "no more ink");
    }
  }
}

TEST(Postbox, AFailureLeavesNoLargeMessageBehind)
{
  constexpr std::size_t size = 40'000'000;
  for (int run = 0; run < 2; ++run)
  {
    Postbox box(controller());
    const auto work = [&]()
    {
      box.post((box.rank() + 1) % box.size(), Note, filled(size, 'x'));
      throw std::runtime_error("nobody takes it");
    };
    EXPECT_THROW(box.together(work), RankFailure);
  }
}

TEST(Postbox, ATakerThatFailsEndsAllRanksAndLeavesNothingBehind)
{
  constexpr std::size_t size = 5'000'000;
  for (int run = 0; run < 2; ++run)
  {
    Postbox box(controller());
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

TEST(Postbox, WorkWithinWorkFailsOnceOnAllRanks)
{
  Postbox box(controller());
  const auto inner = [&]()
  {
    if (box.rank() == box.size() - 1)
    {
      throw std::runtime_error("deep inside");
    }
    box.wait(Note, box.size() - 1);
  };
  try
  {
    box.together([&]() { box.together(inner); });
    FAIL() << "nothing was thrown";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_STREQ(failure.what(), "deep inside");
    EXPECT_EQ(failure.Rank, box.size() - 1);
  }
}

TEST(Postbox, OfSeveralFailuresAllRanksHearOfTheLowestRanks)
{
  Postbox box(controller());
  try
  {
    box.together([&]() { throw std::runtime_error("rank " + std::to_string(box.rank())); });
    FAIL() << "nothing was thrown";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_STREQ(failure.what(), "rank 0");
  }
}

TEST(Postbox, TellsWhatWasSentByKind)
{
  Postbox box(controller());
  box.post((box.rank() + 1) % box.size(), Note, filled(100, 'x'));
  box.wait(Note, (box.rank() + box.size() - 1) % box.size());
  const auto sent = box.traffic().find(Note);
  if (box.size() == 1)
  {
    EXPECT_EQ(sent, box.traffic().end()); // to oneself costs nothing
  }
  else
  {
    EXPECT_EQ(sent->second.Messages, 1);
    EXPECT_GE(sent->second.Bytes, 100);
  }
  box.barrier();
}

TEST(ByteReader, RefusesToReadBeyondTheEnd)
{
  ByteWriter writer;
  writer.value(std::uint64_t(1000));
  const Bytes bytes = writer.take();
  EXPECT_THROW(ByteReader(bytes).array<double>(), std::runtime_error);
  EXPECT_THROW(ByteReader(bytes).raw(9), std::runtime_error);
}

} // namespace
