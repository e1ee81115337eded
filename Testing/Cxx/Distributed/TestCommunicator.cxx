// SPDX-License-Identifier: BSD-3-Clause
#include "CommunicatorTesting.h"

#include <numeric>

namespace
{

using namespace tipp;
using namespace tipp::test;

constexpr MessageKind Note = MessageKind::FirstFree;

TEST(Communicator, NoControllerIsOneRank)
{
  Communicator box(nullptr);
  EXPECT_EQ(box.size(), 1);
  EXPECT_EQ(box.rank(), 0);
  box.post(0, Note, filled(3, 'a'));
  EXPECT_EQ(box.wait(Note, 0).Content.size(), 3u);
}

TEST(Communicator, MessagesOfARankArriveInOrder)
{
  Communicator box(controller());
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

TEST(Communicator, AllRanksMaySendLargeMessagesAtOnce)
{
  Communicator box(controller());
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

TEST(Communicator, AFailureEndsTheWaitOfOtherRanks)
{
  for (int failing = 0; failing < controller()->GetNumberOfProcesses(); ++failing)
  {
    Communicator box(controller());
    try
    {
      box.together(
        [&]()
        {
          if (box.rank() == failing)
          {
            throw std::runtime_error("no more ink");
          }
          box.wait(Note, failing); // a message that is never sent
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

TEST(Communicator, AFailureLeavesNoLargeMessageBehind)
{
  constexpr std::size_t size = 40'000'000;
  for (int run = 0; run < 2; ++run)
  {
    Communicator box(controller());
    const auto work = [&]()
    {
      box.post((box.rank() + 1) % box.size(), Note, filled(size, 'x'));
      throw std::runtime_error("nobody takes it");
    };
    EXPECT_THROW(box.together(work), RankFailure);
  }
}

/// One rank may start new work while another has not yet received the last failure.
TEST(Communicator, WorksAfterFailures)
{
  Communicator box(controller());
  for (int run = 0; run < 200; ++run)
  {
    const int failing = run % box.size();
    try
    {
      box.together(
        [&]()
        {
          if (box.rank() == failing)
          {
            throw std::runtime_error(std::to_string(run));
          }
          box.wait(Note, failing); // a message that is never sent
        });
      FAIL() << "nothing was thrown";
    }
    catch (const RankFailure& failure)
    {
      ASSERT_STREQ(std::to_string(run).c_str(), failure.what());
    }
    std::vector<std::int64_t> count = { 1 };
    run % 2 == 0 ? box.sum(count) : box.together([&]() { box.sum(count); });
    ASSERT_EQ(box.size(), count[0]);
  }
}

TEST(Communicator, AFailureMayHaveALongReason)
{
  Communicator box(controller());
  const auto work = [&]()
  {
    if (box.rank() == 0)
    {
      throw std::runtime_error(std::string(200'000, 'x'));
    }
    box.wait(Note, 0); // a message that is never sent
  };
  try
  {
    box.together(work);
    FAIL() << "nothing was thrown";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_EQ(std::string("xxx"), std::string(failure.what(), 3));
  }
}

TEST(Communicator, NestedWorkFailsOnceOnAllRanks)
{
  Communicator box(controller());
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

TEST(Communicator, AllRanksReportTheFailureOfTheLowestRank)
{
  Communicator box(controller());
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

TEST(Communicator, CountsSentBytesByKind)
{
  Communicator box(controller());
  box.post((box.rank() + 1) % box.size(), Note, filled(100, 'x'));
  box.wait(Note, (box.rank() + box.size() - 1) % box.size());
  const auto sent = box.traffic().find(Note);
  if (box.size() == 1)
  {
    EXPECT_EQ(sent, box.traffic().end()); // messages of a rank to itself are not counted
  }
  else
  {
    EXPECT_EQ(sent->second.Messages, 1);
    EXPECT_GE(sent->second.Bytes, 100);
  }
  box.barrier();
}

TEST(LoadArchive, RefusesToReadBeyondTheEnd)
{
  SaveArchive writer;
  writer(std::uint64_t(1000));
  const Bytes bytes = writer.take();
  EXPECT_THROW(unpacked<std::vector<double>>(bytes), std::runtime_error);
  EXPECT_THROW(LoadArchive(bytes).raw(9), std::runtime_error);
}

} // namespace
