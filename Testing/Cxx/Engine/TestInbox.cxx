// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Dataflow.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <thread>

namespace
{

using namespace tipp;

VertexMessage messageOf(PartitionIndex sender, const std::vector<std::int64_t>& ids)
{
  VertexMessage message{ sender, 1, {} };
  for (const std::int64_t id : ids)
  {
    message.Vertices.push_back({ { double(id), 0 }, id, 0 });
  }
  return message;
}

std::vector<std::int64_t> idsOf(const std::vector<BoundaryVertex>& vertices)
{
  std::vector<std::int64_t> ids;
  for (const BoundaryVertex& v : vertices)
  {
    ids.push_back(v.Id);
  }
  return ids;
}

TEST(Inbox, SortsMessagesBySender)
{
  std::vector<PartitionIndex> senders(20);
  std::iota(senders.begin(), senders.end(), -1);
  std::mt19937_64 random(5);
  for (int draw = 0; draw < 10; ++draw)
  {
    std::shuffle(senders.begin(), senders.end(), random);
    Inbox inbox;
    for (const PartitionIndex sender : senders)
    {
      inbox.put(messageOf(sender, { sender }));
    }
    const std::vector<VertexMessage> messages = inbox.take();
    ASSERT_EQ(senders.size(), messages.size());
    for (std::size_t i = 0; i < messages.size(); ++i)
    {
      EXPECT_EQ(PartitionIndex(i) - 1, messages[i].Sender);
      EXPECT_EQ(PartitionIndex(i) - 1, messages[i].Vertices.front().Id);
    }
  }
}

TEST(Inbox, IsEmptyAfterItsMessagesWereTaken)
{
  Inbox inbox;
  inbox.put(messageOf(0, { 1 }));
  EXPECT_EQ(1U, inbox.take().size());
  EXPECT_TRUE(inbox.take().empty());
}

TEST(Inbox, KeepsTheMessagesOfManyThreads)
{
  constexpr int threads = 4;
  constexpr int each = 2000;
  Inbox inbox;
  std::vector<std::thread> senders;
  for (int t = 0; t < threads; ++t)
  {
    senders.emplace_back(
      [&inbox, t]
      {
        for (int i = 0; i < each; ++i)
        {
          inbox.put(messageOf(t * each + i, { i }));
        }
      });
  }
  for (std::thread& sender : senders)
  {
    sender.join();
  }
  const std::vector<VertexMessage> messages = inbox.take();
  ASSERT_EQ(std::size_t(threads * each), messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    ASSERT_EQ(PartitionIndex(i), messages[i].Sender);
  }
}

TEST(UniqueVertices, CollectsEachVertexOnceInOrderOfFirstAppearance)
{
  EXPECT_EQ((std::vector<std::int64_t>{ 5, -1, 7, 3 }),
    idsOf(UniqueVertices().collect({ messageOf(0, { 5, -1, 7 }), messageOf(1, { 7, 3, -1 }) })));
}

TEST(UniqueVertices, WithoutMessagesThereAreNone)
{
  EXPECT_TRUE(UniqueVertices().collect({}).empty());
}

TEST(UniqueVertices, CollectsManyVertices)
{
  std::vector<std::int64_t> ids(5000);
  std::iota(ids.begin(), ids.end(), -2500);
  UniqueVertices unique;
  EXPECT_EQ(ids, idsOf(unique.collect({ messageOf(0, ids), messageOf(1, ids) })));
  EXPECT_EQ((std::vector<std::int64_t>{ 9 }), idsOf(unique.collect({ messageOf(0, { 9 }) })));
}

} // namespace
