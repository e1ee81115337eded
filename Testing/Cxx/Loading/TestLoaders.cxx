// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/VertexLoader.h"

#include "ExpectIOError.h"
#include "LruLoader.h"
#include "TemporaryFolder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <ostream>
#include <random>
#include <stdexcept>

namespace
{

using tipp::IOError;
using tipp::Loader;
using tipp::LoaderOptions;
using tipp::makeVertexLoader;
using tipp::RawArray;
using tipp::Scalar;
using tipp::benchmark::LruLoader;
using Ids = std::vector<std::int64_t>;

constexpr std::int64_t tuples = 5000;

/// Three arrays in two files, whose tuples hold their own id.
class Source
{
public:
  Source()
  {
    std::string one(11, '!');
    std::string two;
    for (std::int64_t id = 0; id < tuples; ++id)
    {
      const double xyz[3] = { double(id), id + 0.25, id + 0.5 };
      one.append(reinterpret_cast<const char*>(xyz), sizeof(xyz));
      const auto low = std::uint8_t(id * 7);
      two += char(low);
    }
    const std::uint64_t wide = one.size();
    for (std::int64_t id = 0; id < tuples; ++id)
    {
      for (int i = 0; i < 5; ++i)
      {
        const auto value = std::int16_t(id + i);
        one.append(reinterpret_cast<const char*>(&value), sizeof(value));
      }
    }
    const std::string first = this->Folder.file("one", one);
    const std::string second = this->Folder.file("two", two);
    this->Arrays = { { "xyz", first, 11, Scalar::Float64, 3, tuples },
      { "low", second, 0, Scalar::UInt8, 1, tuples },
      { "wide", first, wide, Scalar::Int16, 5, tuples } };
  }

  std::vector<RawArray> Arrays;
  tipp::test::TemporaryFolder Folder;
};

const Source& source()
{
  static const Source made;
  return made;
}

/// Loads ids in chunks and compares each tuple with its id.
void expectRight(tipp::VertexLoader& loader, const Ids& ids, std::size_t chunk)
{
  for (std::size_t first = 0; first < ids.size(); first += chunk)
  {
    const std::size_t size = std::min(chunk, ids.size() - first);
    std::vector<double> xyz(3 * size, -1);
    std::vector<std::uint8_t> low(size, 77);
    std::vector<std::int16_t> wide(5 * size, -1);
    void* const out[] = { xyz.data(), low.data(), wide.data() };
    loader.load(ids.data() + first, size, out);
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::int64_t id = ids[first + i];
      ASSERT_EQ(double(id), xyz[3 * i]);
      ASSERT_EQ(id + 0.5, xyz[3 * i + 2]);
      ASSERT_EQ(std::uint8_t(id * 7), low[i]);
      ASSERT_EQ(std::int16_t(id), wide[5 * i]);
      ASSERT_EQ(std::int16_t(id + 4), wide[5 * i + 4]);
    }
  }
}

/// Lists of ids: random, ascending, all equal, from both ends, in clusters that are far apart.
std::vector<Ids> patterns()
{
  std::mt19937_64 random(11);
  std::vector<Ids> all(5, Ids(3000));
  for (std::size_t i = 0; i < 3000; ++i)
  {
    all[0][i] = std::int64_t(random() % tuples);
    all[1][i] = std::int64_t(i);
    all[2][i] = 1234;
    all[3][i] = i % 2 ? 0 : tuples - 1;
    all[4][i] = std::int64_t(i % 3 * 2400 + random() % 20);
  }
  return all;
}

struct Case
{
  Loader Kind;
  std::int64_t M;
};

std::ostream& operator<<(std::ostream& stream, const Case& one)
{
  constexpr std::array<const char*, 4> names = { "auto", "direct", "fine", "mmap" };
  return stream << names[std::size_t(one.Kind)] << "M" << one.M;
}

class Loaders : public testing::TestWithParam<Case>
{
};

std::vector<Case> cases()
{
  std::vector<Case> all;
  for (const Loader kind : { Loader::Direct, Loader::Fine, Loader::Mmap, Loader::Auto })
  {
    // M of 1, around a power of two, half of the tuples, one less than all, all, and more than all.
    for (const std::int64_t m : { 1, 2, 7, 100, 1023, 1024, 1025, 2500, 4999, 5000, 100000, 0 })
    {
      all.push_back({ kind, m });
    }
  }
  return all;
}

/// An array whose tuples are their own ids, in a file that can be truncated.
class OwnIds
{
public:
  explicit OwnIds(std::int64_t count)
    : Content(std::size_t(8 * count), '!')
    , Count(count)
  {
    for (std::int64_t id = 0; id < count; ++id)
    {
      std::memcpy(&this->Content[std::size_t(8 * id)], &id, 8);
    }
    this->Path = this->Folder.file("ids", this->Content);
  }

  std::unique_ptr<tipp::VertexLoader> fineLoader(std::int64_t m) const
  {
    LoaderOptions options;
    options.Kind = Loader::Fine;
    options.M = m;
    return makeVertexLoader({ { "ids", this->Path, 0, Scalar::Int64, 1, this->Count } }, options);
  }

  static Ids loaded(tipp::VertexLoader& loader, const Ids& ids)
  {
    Ids got(ids.size());
    void* const out[] = { got.data() };
    loader.load(ids.data(), ids.size(), out);
    return got;
  }

  void cut(std::int64_t count) const { std::filesystem::resize_file(this->Path, 8 * count); }
  void restore() const { std::ofstream(this->Path, std::ios::binary) << this->Content; }

private:
  tipp::test::TemporaryFolder Folder;
  std::string Content;
  std::string Path;
  std::int64_t Count;
};

Ids from(std::int64_t first, std::size_t count)
{
  Ids ids(count);
  std::iota(ids.begin(), ids.end(), first);
  return ids;
}

} // namespace

TEST_P(Loaders, LoadEveryTupleForAnyChunk)
{
  for (const Ids& ids : patterns())
  {
    for (const std::size_t chunk : { 1, 3, 64, 1000, 3000 })
    {
      LoaderOptions options;
      options.Kind = GetParam().Kind;
      options.M = GetParam().M;
      const auto loader = makeVertexLoader(source().Arrays, options);
      const Ids part(ids.begin(), ids.begin() + std::ptrdiff_t(std::min(3000UL, 40 * chunk)));
      expectRight(*loader, part, chunk);
    }
  }
}

TEST_P(Loaders, RefuseInvalidIds)
{
  LoaderOptions options;
  options.Kind = GetParam().Kind;
  options.M = GetParam().M;
  const auto loader = makeVertexLoader({ source().Arrays[0] }, options);
  std::vector<double> xyz(6);
  void* const out[] = { xyz.data() };
  for (const std::int64_t bad : { std::int64_t(-1), tuples, std::int64_t(1) << 62 })
  {
    const Ids ids{ 3, bad };
    tipp::test::expectIOError(source().Arrays[0].Path, "has no vertex " + std::to_string(bad),
      [&] { loader->load(ids.data(), 2, out); });
  }
}

TEST_P(Loaders, DoNothingForNoIds)
{
  LoaderOptions options;
  options.Kind = GetParam().Kind;
  options.M = GetParam().M;
  const auto loader = makeVertexLoader(source().Arrays, options);
  void* const out[] = { nullptr, nullptr, nullptr };
  loader->load(nullptr, 0, out);
  EXPECT_EQ(0, loader->counters().Reads);
}

INSTANTIATE_TEST_SUITE_P(Each, Loaders, testing::ValuesIn(cases()),
  [](const auto& info) { return testing::PrintToString(info.param); });

TEST(Loader, LoadsTheSameWithAnyNumberOfThreads)
{
  std::mt19937_64 random(2);
  Ids ids(400000);
  std::generate(ids.begin(), ids.end(), [&] { return std::int64_t(random() % tuples); });
  for (const Loader kind : { Loader::Direct, Loader::Fine, Loader::Mmap })
  {
    for (const int threads : { 1, 2, 3 })
    {
      LoaderOptions options;
      options.Kind = kind;
      options.M = 1500;
      options.Threads = threads;
      expectRight(*makeVertexLoader(source().Arrays, options), ids, ids.size());
    }
  }
}

TEST(DirectLoader, ReadsEachActiveSegmentOnce)
{
  LoaderOptions options;
  options.Kind = Loader::Direct;
  options.M = 1000;
  const auto loader = makeVertexLoader({ source().Arrays[0] }, options);
  std::vector<double> xyz(3 * 4);
  void* const out[] = { xyz.data() };
  // From tuple 100 on, the ids are in segments 0, 3 and 4 of five. The last segment ends with the
  // range.
  const Ids ids{ 100, 4500, 3200, 150 };
  loader->load(ids.data(), ids.size(), out);
  EXPECT_EQ(3, loader->counters().Reads);
  EXPECT_EQ(3, loader->counters().Passes);
  EXPECT_EQ((1000 + 1000 + 401) * 24, loader->counters().Bytes);
  EXPECT_EQ(4 * 24, loader->counters().UsefulBytes);
}

TEST(DirectLoader, ReadsOnlyTheRangeIfItFits)
{
  LoaderOptions options;
  options.Kind = Loader::Direct;
  options.M = 1000;
  const auto loader = makeVertexLoader({ source().Arrays[0] }, options);
  std::vector<double> xyz(3 * 2);
  void* const out[] = { xyz.data() };
  const Ids ids{ 1999, 1000 };
  loader->load(ids.data(), ids.size(), out);
  EXPECT_EQ(1, loader->counters().Reads);
  EXPECT_EQ(1000 * 24, loader->counters().Bytes);
}

TEST(FineLoader, ReadsLittleMoreThanRequested)
{
  LoaderOptions options;
  options.Kind = Loader::Fine;
  options.M = 3000;
  const auto loader = makeVertexLoader({ source().Arrays[0] }, options);
  std::vector<double> xyz(3 * 2);
  void* const out[] = { xyz.data() };
  const Ids ids{ 0, 4999 };
  loader->load(ids.data(), ids.size(), out);
  EXPECT_EQ(2, loader->counters().Reads);
  EXPECT_EQ(1, loader->counters().Passes);
  EXPECT_EQ(2 * 24, loader->counters().Bytes);
}

TEST(FineLoader, SoonReadsNothingTwiceIfAllFits)
{
  LoaderOptions options;
  options.Kind = Loader::Fine;
  options.M = tuples;
  const auto loader = makeVertexLoader(source().Arrays, options);
  for (int round = 0; round < 30; ++round)
  {
    for (const Ids& ids : patterns())
    {
      expectRight(*loader, ids, 300);
    }
  }
  const std::int64_t whole = tuples * (3 * 8 + 1 + 5 * 2);
  EXPECT_LE(loader->counters().Bytes, 4 * whole);
  EXPECT_GT(loader->counters().UsefulBytes, 100 * whole / 2);
}

TEST(FineLoader, ReadsTheBlocksOfConsecutiveChunksOnce)
{
  LoaderOptions options;
  options.Kind = Loader::Fine;
  options.M = 4000; // fewer than all tuples, but more than both chunks need
  const auto loader = makeVertexLoader(source().Arrays, options);
  Ids ids(1500);
  std::iota(ids.begin(), ids.end(), 0);
  expectRight(*loader, ids, ids.size());
  const std::int64_t once = loader->counters().Bytes;
  expectRight(*loader, ids, ids.size());
  EXPECT_EQ(once, loader->counters().Bytes);
  std::iota(ids.begin(), ids.end(), 1000);
  expectRight(*loader, ids, ids.size());
  EXPECT_EQ(once + 1024 * (24 + 1 + 10), loader->counters().Bytes);
}

TEST(FineLoader, IsCorrectForFewIdsAfterBlocksAndGroups)
{
  LoaderOptions options;
  options.Kind = Loader::Fine;
  options.M = 2100;
  const auto loader = makeVertexLoader(source().Arrays, options);
  Ids ids(4 * 1000);
  for (int round = 0; round < 3; ++round)
  {
    std::iota(ids.begin(), ids.end(), 300 * round);
    expectRight(*loader, ids, 1000);
    expectRight(*loader, ids, ids.size());
    expectRight(*loader, { 1, 4999, 2600 }, 3);
  }
}

TEST(FineLoader, FewIdsInSeveralPassesAreAllFound)
{
  LoaderOptions options;
  options.Kind = Loader::Fine;
  options.M = 2;
  const auto loader = makeVertexLoader(source().Arrays, options);
  expectRight(*loader, { 4999, 3, 4999, 2500, 3, 1200, 0, 3 }, 8);
  EXPECT_EQ(4, loader->counters().Passes); // ids 0 and 3 are read together
}

TEST(FineLoader, KeepsFewFarIdsForTheNextChunks)
{
  LoaderOptions options;
  options.Kind = Loader::Fine;
  options.M = 100;
  const auto loader = makeVertexLoader({ source().Arrays[0] }, options);
  std::vector<double> xyz(3 * 3);
  void* const out[] = { xyz.data() };
  const Ids first{ 10, 2500, 4990 };
  loader->load(first.data(), first.size(), out);
  EXPECT_EQ(3, loader->counters().Reads);
  const Ids next{ 4990, 1300, 10 };
  loader->load(next.data(), next.size(), out);
  EXPECT_EQ(4, loader->counters().Reads);
  EXPECT_EQ(4990, xyz[0]);
  EXPECT_EQ(1300, xyz[3]);
  EXPECT_EQ(10, xyz[6]);
}

TEST(FineLoader, IsCorrectAfterAFailedRead)
{
  const OwnIds source(1000);
  const auto loader = source.fineLoader(64);
  source.cut(500);
  const Ids ids{ 10, 900 };
  EXPECT_THROW(OwnIds::loaded(*loader, ids), IOError);
  source.restore();
  EXPECT_EQ(ids, OwnIds::loaded(*loader, ids));
}

TEST(FineLoader, IsCorrectAfterAFailedReadOfNeighbours)
{
  const OwnIds source(1000);
  const auto loader = source.fineLoader(800);
  EXPECT_EQ(from(0, 300), OwnIds::loaded(*loader, from(0, 300)));
  source.cut(520);
  EXPECT_THROW(OwnIds::loaded(*loader, from(300, 300)), IOError);
  source.restore();
  EXPECT_EQ(from(300, 300), OwnIds::loaded(*loader, from(300, 300)));
}

TEST(FineLoader, IsCorrectOnceAllTuplesAreKept)
{
  const OwnIds source(300000);
  const auto loader = source.fineLoader(300000);
  for (const std::int64_t first : { 0, 100000, 200000, 0, 60000, 100000, 130000, 200000 })
  {
    const Ids ids = from(first, 100000);
    ASSERT_TRUE(ids == OwnIds::loaded(*loader, ids)) << first;
  }
}

TEST(LruLoader, CountsAMissForEachBlockThatItReads)
{
  LruLoader loader(source().Arrays, 1000, 10);
  std::vector<double> xyz(3 * 4);
  std::vector<std::uint8_t> low(4);
  std::vector<std::int16_t> wide(5 * 4);
  void* const out[] = { xyz.data(), low.data(), wide.data() };
  const Ids ids{ 5, 450, 99, 401 };
  loader.load(ids.data(), ids.size(), out);
  EXPECT_EQ(2, loader.misses());
  EXPECT_EQ(3 * 2, loader.counters().Reads);
  EXPECT_EQ(2 * 100 * (24 + 1 + 10), loader.counters().Bytes);
}

TEST(LruLoader, ReadsAReplacedBlockAgain)
{
  LruLoader loader(source().Arrays, 200, 2);
  expectRight(loader, { 5, 150, 250, 150, 5, 250 }, 6);
  EXPECT_EQ(5, loader.misses()); // only the second 150 is held
}

TEST(LruLoader, LoadsEveryTupleForAnySize)
{
  for (const std::int64_t m : { 1, 7, 1024, 4999, 5000 })
  {
    for (const std::int64_t blocks : { 1, 16, 100000 })
    {
      for (const Ids& ids : patterns())
      {
        LruLoader loader(source().Arrays, m, blocks);
        expectRight(loader, ids, 1000);
      }
    }
  }
}

TEST(AutoLoader, MapsAFileThatFitsIntoHalfTheMemory)
{
  LoaderOptions options;
  options.MemoryLimit = 2 * 24 * tuples;
  EXPECT_STREQ("mmap", makeVertexLoader({ source().Arrays[0] }, options)->name());
  options.MemoryLimit -= 2 * 24;
  EXPECT_STREQ("fine", makeVertexLoader({ source().Arrays[0] }, options)->name());
}

TEST(MakeVertexLoader, RefusesAnArrayThatItsFileDoesNotHold)
{
  for (const auto& change :
    std::vector<RawArray>{ { "low", source().Arrays[1].Path, 1, Scalar::UInt8, 1, tuples },
      { "low", source().Arrays[1].Path, 0, Scalar::UInt16, 1, tuples },
      { "low", source().Arrays[1].Path, ~std::uint64_t(0), Scalar::UInt8, 1, tuples },
      { "low", source().Arrays[1].Path, 0, Scalar::UInt8, 1, std::int64_t(1) << 62 },
      { "low", source().Arrays[1].Path, 0, Scalar::Float64, 4, std::int64_t(1) << 60 },
      { "low", source().Arrays[1].Path, 0, Scalar::UInt8, 1, -1 } })
  {
    tipp::test::expectIOError(change.Path, "does not hold", [&] { makeVertexLoader({ change }); });
  }
}

TEST(MakeVertexLoader, RefusesArraysThatDiffer)
{
  RawArray shorter = source().Arrays[1];
  --shorter.Tuples;
  EXPECT_THROW(makeVertexLoader({ source().Arrays[0], shorter }), std::invalid_argument);
}

TEST(MakeVertexLoader, ReportsAFileThatIsTruncatedMeanwhile)
{
  const tipp::test::TemporaryFolder folder;
  const std::string path = folder.file("data", std::string(8000, 'x'));
  const RawArray array{ "x", path, 0, Scalar::Float64, 1, 1000 };
  for (const Loader kind : { Loader::Direct, Loader::Fine })
  {
    std::ofstream(path) << std::string(8000, 'x');
    LoaderOptions options;
    options.Kind = kind;
    const auto loader = makeVertexLoader({ array }, options);
    std::filesystem::resize_file(path, 4000);
    std::vector<double> x(1);
    void* const out[] = { x.data() };
    const Ids ids{ 900 };
    tipp::test::expectIOError(path, "ends at byte", [&] { loader->load(ids.data(), 1, out); });
  }
}

TEST(LoaderFromName, AcceptsTheKnownNamesOnly)
{
  EXPECT_EQ(Loader::Auto, tipp::loaderFromName("auto"));
  EXPECT_EQ(Loader::Direct, tipp::loaderFromName("direct"));
  EXPECT_EQ(Loader::Fine, tipp::loaderFromName("fine"));
  EXPECT_EQ(Loader::Mmap, tipp::loaderFromName("mmap"));
  EXPECT_THROW(tipp::loaderFromName("quick"), std::invalid_argument);
}
