// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/FinalTriangles.h"
#include "Distributed/TaskMessages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tipp
{
namespace
{

Message received(Bytes content)
{
  return { 1, MessageKind::FirstFree, std::move(content) };
}

TaskResult someResult()
{
  TaskResult result;
  result.Area = 2;
  result.Partition = 7;
  result.WorkerVertices = 1000;
  result.Seconds = 0.25;
  result.Seams.Met = { 3, 4 };
  result.Seams.Labels = { 12 };
  result.Seams.Vertices = { { { 0, 0 }, 10 }, { { 1, 0 }, 11 }, { { 0, 1 }, 12 } };
  result.Seams.Triangles = { { 0, 1, 2 } };
  result.Seams.Groups = { { 2, 1, 3, 1, 0 } };
  return result;
}

TEST(TaskMessages, TaskArrivesAsItWasSent)
{
  Task task;
  task.Area = 5;
  task.Partition = 9;
  task.Vertices = { { { 0.5, -1 }, 42 }, { { 2, 3 }, -1 } };
  const Task got = unpackTask(received(pack(task)));
  EXPECT_EQ(got.Area, 5);
  EXPECT_EQ(got.Partition, 9);
  ASSERT_EQ(got.Vertices.size(), 2u);
  EXPECT_EQ(got.Vertices[0].Id, 42);
  EXPECT_EQ(got.Vertices[1].Place, (Point2{ 2, 3 }));
}

TEST(TaskMessages, ResultArrivesAsItWasSent)
{
  const TaskResult got = unpackResult(received(pack(someResult())));
  EXPECT_EQ(got.Area, 2);
  EXPECT_EQ(got.Partition, 7);
  EXPECT_EQ(got.WorkerVertices, 1000);
  EXPECT_EQ(got.Seconds, 0.25);
  ASSERT_EQ(got.Seams.size(), 1u);
  EXPECT_EQ(got.Seams.met(0)[1], 4);
  EXPECT_EQ(got.Seams.vertices(0)[2].Id, 12);
  EXPECT_EQ(got.Seams.triangles(0)[0], (SeamGroups::Corners{ 0, 1, 2 }));
}

TEST(TaskMessages, EveryShorterMessageIsRefused)
{
  const Bytes whole = pack(someResult());
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    Bytes part(size);
    std::copy_n(whole.begin(), size, part.begin());
    EXPECT_THROW(unpackResult(received(std::move(part))), std::runtime_error) << size << " bytes";
  }
}

TEST(ByteWriter, BeginsAnewOnceItsBytesAreTaken)
{
  ByteWriter writer;
  for (int i = 0; i < 1000; ++i)
  {
    writer.value(i);
  }
  const Bytes first = writer.take();
  writer.value(char(7));
  const Bytes second = writer.take();
  ASSERT_EQ(first.size(), 1000 * sizeof(int));
  ByteReader reader(first);
  for (int i = 0; i < 1000; ++i)
  {
    ASSERT_EQ(reader.value<int>(), i);
  }
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0], 7);
  EXPECT_TRUE(writer.take().empty());
}

TEST(FinalTriangles, AreVisitedOnceEachAfterAppending)
{
  FinalTriangles all;
  FinalTriangles others;
  constexpr std::int64_t count = 10'000;
  for (std::int64_t i = 0; i < count; ++i)
  {
    (i % 2 == 0 ? all : others).push_back({ i, i + 1, i + 2 });
  }
  all.append(std::move(others));
  all.push_back({ count, 0, 0 });
  std::vector<std::int64_t> firsts;
  all.visit([&firsts](const IdTriangle& triangle) { firsts.push_back(triangle[0]); });
  std::sort(firsts.begin(), firsts.end());
  ASSERT_EQ(firsts.size(), std::size_t(count) + 1);
  for (std::int64_t i = 0; i <= count; ++i)
  {
    ASSERT_EQ(firsts[std::size_t(i)], i);
  }
}

} // namespace
} // namespace tipp
