// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/TileStore.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// A raster of two tiles, 256 and 44 pixels wide. Both are 10 pixels high.
class TileStores : public testing::Test
{
protected:
  TileStores() { this->Grid = { 0, 0, { 1, 1 }, 300, 10, std::nullopt }; }

  std::unique_ptr<TileStore> open()
  {
    return std::make_unique<TileStore>(this->Folder.path("pixels"), this->Grid, 1, true,
      [this](const RasterWindow& window, std::vector<std::vector<double>>& values)
      {
        ++this->Finished;
        FinishedTile tile;
        tile.Filled = window.Columns * window.Rows;
        tile.Encoded.Bands.push_back({ {}, "encoded " + std::to_string(values[0][0]) });
        return tile;
      });
  }

  static void set(TileStore& store, const RasterWindow& window, double value)
  {
    const auto count = std::size_t(window.Columns * window.Rows);
    store.set(window, std::vector<unsigned char>(count, 1), { std::vector<double>(count, value) });
  }

  TemporaryFolder Folder;
  RasterGrid Grid;
  int Finished = 0;
};

TEST_F(TileStores, FinishATileWhenItsLastPixelIsSet)
{
  auto store = this->open();
  set(*store, { 0, 0, 300, 6 }, 3); // touches both tiles
  EXPECT_FALSE(store->readFinished(0));
  set(*store, { 0, 4, 256, 5 }, 3);
  EXPECT_FALSE(store->readFinished(0));
  set(*store, { 0, 9, 256, 1 }, 4);
  const std::optional<FinishedTile> tile = store->readFinished(0);
  ASSERT_TRUE(tile);
  EXPECT_EQ(2560, tile->Filled);
  ASSERT_EQ(1U, tile->Encoded.Bands.size());
  EXPECT_EQ("encoded 3.000000", tile->Encoded.Bands[0].Bytes);
  EXPECT_FALSE(store->readFinished(1));
  std::vector<std::vector<double>> values;
  store->read(tileOf(this->Grid, 1), values);
  EXPECT_EQ(3, values[0][0]);
  EXPECT_TRUE(std::isnan(values[0].back()));
}

TEST_F(TileStores, KeepFinishedTilesForAResumedRun)
{
  set(*this->open(), { 0, 0, 256, 5 }, 3);
  set(*this->open(), { 0, 2, 256, 8 }, 3);
  auto store = this->open();
  ASSERT_TRUE(store->readFinished(0));
  set(*store, { 0, 0, 256, 10 }, 3);
  const double value = 7;
  store->setIfMissing(5, &value);
  EXPECT_EQ(1, this->Finished);
  EXPECT_EQ("encoded 3.000000", store->readFinished(0)->Encoded.Bands[0].Bytes);
}

/// Sets pixels of both tiles from two threads. Returns the number of calls that fail.
int setFromThreads(TileStore& store)
{
  std::atomic<int> failures{ 0 };
  const auto work = [&](int first)
  {
    for (int i = 0; i < 1000; ++i)
    {
      try
      {
        const std::int64_t column = (i + first) % 2 == 0 ? 0 : 256;
        store.set({ column, i % 9, 1, 1 }, { 1 }, { { double(column) } });
      }
      catch (const std::exception&)
      {
        ++failures;
      }
    }
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  return failures;
}

TEST_F(TileStores, ThreadsOfTwoProcessesCauseNoDeadlockError)
{
  const pid_t child = fork();
  if (child == 0)
  {
    _exit(setFromThreads(*this->open()));
  }
  EXPECT_EQ(0, setFromThreads(*this->open()));
  int status = -1;
  ASSERT_EQ(child, waitpid(child, &status, 0));
  EXPECT_EQ(0, status);
}

TEST_F(TileStores, TilesThatDoNotFitAreNotFinished)
{
  TileStore store(this->Folder.path("pixels"), this->Grid, 1, true,
    [](const RasterWindow&, std::vector<std::vector<double>>&)
    {
      FinishedTile tile;
      tile.Encoded.Bands.push_back({ {}, std::string(std::size_t(1) << 20, 'x') });
      return tile;
    });
  set(store, { 0, 0, 300, 10 }, 3);
  EXPECT_FALSE(store.readFinished(0));
  std::vector<std::vector<double>> values;
  store.read(tileOf(this->Grid, 0), values);
  EXPECT_EQ(std::vector<double>(2560, 3), values[0]);
}

} // namespace
