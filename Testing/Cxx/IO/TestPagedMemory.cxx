// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include "Files/PagedMemory.h"
#include "Files/Platform.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include <sys/resource.h>

namespace
{

using tipp::PagedMemory;
using tipp::test::expectIOError;
using tipp::test::TemporaryFolder;

constexpr std::uint64_t MiB = std::uint64_t(1) << 20;

/// A value for each index that differs from those nearby.
std::uint64_t valueAt(std::size_t i)
{
  return i * 0x9e3779b97f4a7c15U;
}

TEST(PagedMemory, ArraysBeginAsZeros)
{
  const TemporaryFolder folder;
  PagedMemory memory(folder.path("."), MiB);
  const auto buffer = memory.buffer<std::uint64_t>(100000);
  ASSERT_EQ(100000U, buffer.size());
  for (const std::uint64_t value : buffer)
  {
    ASSERT_EQ(0U, value);
  }
}

TEST(PagedMemory, ContentStaysWhilePagesAreHandedBack)
{
  const TemporaryFolder folder;
  PagedMemory memory(folder.path("."), MiB); // less than the program itself
  auto buffer = memory.buffer<std::uint64_t>(8 * MiB);
  const auto half = [&](std::size_t begin)
  {
    for (std::size_t i = begin; i < buffer.size(); i += 2)
    {
      buffer[i] = valueAt(i);
    }
  };
  std::thread odd([&] { half(1); });
  half(0);
  odd.join();
  for (std::size_t i = 0; i < buffer.size(); ++i)
  {
    ASSERT_EQ(valueAt(i), buffer[i]);
  }
}

TEST(PagedMemory, ResidentMemoryStaysBounded)
{
  if (tipp::residentMemory().Bytes == 0)
  {
    GTEST_SKIP() << "this system does not say how much memory is resident";
  }
  const TemporaryFolder folder;
  const std::uint64_t before = tipp::residentMemory().Bytes;
  PagedMemory memory(folder.path("."), before + 32 * MiB);
  auto buffer = memory.buffer<std::uint64_t>(32 * MiB); // 256 MiB
  std::uint64_t most = 0;
  for (std::size_t i = 0; i < buffer.size(); ++i)
  {
    buffer[i] = i;
    if (i % MiB == 0)
    {
      // The watching thread may wait for a processor.
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      most = std::max(most, tipp::residentMemory().Bytes);
    }
  }
  EXPECT_LT(most, before + 64 * MiB);
}

TEST(PagedMemory, FilesHaveNoNames)
{
  const TemporaryFolder folder;
  PagedMemory memory(folder.path("."), MiB);
  auto buffer = memory.buffer<char>(MiB);
  buffer[0] = 1;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path(".")));
}

TEST(PagedMemory, ArraysOutliveIt)
{
  const TemporaryFolder folder;
  auto memory = std::make_unique<PagedMemory>(folder.path("."), MiB);
  auto buffer = memory->buffer<std::uint64_t>(1000);
  buffer[999] = 5;
  memory.reset();
  EXPECT_EQ(5U, buffer[999]);
}

TEST(PagedMemory, ReleaseCopiesTheArray)
{
  const TemporaryFolder folder;
  PagedMemory memory(folder.path("."), MiB);
  auto buffer = memory.buffer<std::int32_t>(3);
  buffer[2] = 7;
  std::int32_t* const values = buffer.release();
  EXPECT_EQ(0, values[0]);
  EXPECT_EQ(7, values[2]);
  EXPECT_TRUE(buffer.empty());
  std::free(values);
}

TEST(PagedMemory, GrowingArrayKeepsItsAddress)
{
  const TemporaryFolder folder;
  PagedMemory memory(folder.path("."), MiB);
  auto array = memory.reservedArray<std::uint64_t>(std::size_t(1) << 40);
  array.grow(1);
  array[0] = 3;
  const std::uint64_t* const before = array.data();
  array.grow(MiB);
  array[MiB - 1] = 4;
  EXPECT_EQ(before, array.data());
  EXPECT_EQ(3U, array[0]);
  EXPECT_EQ(4U, array[MiB - 1]);
}

TEST(PagedMemory, FullDiskIsAnError)
{
  const TemporaryFolder folder;
  PagedMemory memory(folder.path("."), MiB);
  auto array = memory.reservedArray<char>(64 * MiB);
  // A limit on the size of files simulates a full disk.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{ 2 * MiB, before.rlim_max };
  setrlimit(RLIMIT_FSIZE, &small);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  array.grow(MiB);
  array[MiB - 1] = 1;
  expectIOError(folder.path("."), "cannot hold the temporary files", [&] { array.grow(3 * MiB); });
  EXPECT_EQ(1, array[MiB - 1]);
  std::signal(SIGXFSZ, handler);
  setrlimit(RLIMIT_FSIZE, &before);
}

TEST(PagedMemory, MissingFolderIsAnError)
{
  const TemporaryFolder folder;
  const std::string missing = folder.path("missing");
  expectIOError(missing, "cannot be written", [&] { PagedMemory(missing, MiB); });
}

} // namespace
