// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/BlockCache.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace
{

using tipp::HeldBlocks;
using tipp::TupleRun;
using Ids = std::vector<std::int64_t>;
using Places = std::vector<std::uint32_t>;
using FirstsAndSizes = std::vector<std::pair<std::int64_t, std::int64_t>>;

/// 30 tuples in blocks of 4, with space for 20 tuples. The third and fourth block are in memory.
HeldBlocks someHeld()
{
  HeldBlocks places(2, 30);
  places.setRoom(20);
  places.missing(std::vector<char>(8, 1), 0);
  places.add({ 8, 8 });
  return places;
}

/// The positions that find() returns, or an empty list if it returns false.
Places found(HeldBlocks& places, const Ids& ids)
{
  Places found(ids.size());
  return places.find(ids.data(), ids.size(), found.data()) ? found : Places();
}

/// The runs of tuples that have to be read: first tuple and size.
FirstsAndSizes toRead(const HeldBlocks& places)
{
  FirstsAndSizes runs;
  for (const TupleRun& run : places.found())
  {
    runs.push_back({ run.First, run.Size });
  }
  return runs;
}

} // namespace

TEST(HeldBlocks, FindTuplesOfHeldBlocks)
{
  HeldBlocks places = someHeld();
  EXPECT_EQ(Places({ 0, 7, 5 }), found(places, { 8, 15, 13 }));
  EXPECT_TRUE(places.found().empty());
  EXPECT_EQ(5U, places.finder()(13));
}

TEST(HeldBlocks, PutNewBlocksBehindHeldOnes)
{
  HeldBlocks places = someHeld();
  EXPECT_EQ(Places({ 9, 8, 13, 4, 3, 2, 1, 0 }), found(places, { 17, 16, 21, 12, 11, 10, 9, 8 }));
  EXPECT_EQ((FirstsAndSizes{ { 16, 8 } }), toRead(places));
  places.keepFound();
  EXPECT_EQ(16, places.used());
  EXPECT_EQ(Places({ 15 }), found(places, { 23 }));
}

TEST(HeldBlocks, ReadTheLastBlockUpToTheLastTuple)
{
  HeldBlocks places = someHeld();
  EXPECT_EQ(Places({ 9, 12, 8, 8, 8, 8, 8, 8 }), found(places, { 29, 4, 28, 28, 28, 28, 28, 28 }));
  EXPECT_EQ((FirstsAndSizes{ { 28, 2 }, { 4, 4 } }), toRead(places));
}

TEST(HeldBlocks, RefuseBlocksThatDoNotFit)
{
  HeldBlocks places = someHeld();
  EXPECT_TRUE(found(places, Ids{ 0, 4, 16, 20, 24, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }).empty());
  EXPECT_TRUE(places.found().empty());
  EXPECT_EQ(Places({ 8, 9, 10, 11 }), found(places, { 20, 21, 22, 23 })); // nothing has changed
}

TEST(HeldBlocks, RefuseToReadMoreTuplesThanThereAreIds)
{
  HeldBlocks places = someHeld();
  EXPECT_TRUE(found(places, { 0, 1, 2 }).empty());
  EXPECT_FALSE(found(places, { 0, 1, 2, 3 }).empty());
}

TEST(HeldBlocks, RefuseInvalidIds)
{
  for (const std::int64_t id : { std::int64_t(-1), std::int64_t(30), INT64_MIN, INT64_MAX })
  {
    HeldBlocks places = someHeld();
    EXPECT_TRUE(found(places, { 8, 8, 8, 8, id }).empty()) << id;
  }
}

TEST(HeldBlocks, LoseBlocksWhoseReadFailed)
{
  HeldBlocks places = someHeld();
  EXPECT_FALSE(found(places, { 0, 1, 2, 3 }).empty());
  places.loseFound();
  EXPECT_EQ(8, places.used());
  EXPECT_TRUE(found(places, { 0 }).empty()); // a block is not read for a single id
}

TEST(HeldBlocks, ListActiveBlocksThatAreNotHeld)
{
  HeldBlocks places = someHeld();
  EXPECT_EQ(std::vector<char>({ 1, 0, 0, 0 }), places.missing({ 1, 0, 1, 0 }, 0));
  EXPECT_EQ(std::vector<char>({ 0, 0, 1 }), places.missing({ 1, 1, 1 }, 8));
  places.forget();
  EXPECT_TRUE(places.isEmpty());
  EXPECT_EQ(std::vector<char>({ 1, 1, 1 }), places.missing({ 1, 1, 1 }, 8));
}
