// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include "ExpectIOError.h"
#include "FlatTesting.h"

#include <algorithm>
#include <random>
#include <stdexcept>

namespace
{

using Ids = std::vector<std::int64_t>;
using tipp::CellReader;
using tipp::test::expectIOError;

class Cells : public testing::TestWithParam<const char*>
{
protected:
  tipp::FlatMesh open(const Ids& ids, std::int64_t points) const
  {
    const std::string shape = "(" + std::to_string(ids.size() / 3) + ", 3)";
    if (std::string(GetParam()) == "<i4")
    {
      this->Maker.write(
        "cells.npy", "<i4", shape, std::vector<std::int32_t>(ids.begin(), ids.end()));
    }
    else
    {
      this->Maker.write("cells.npy", "<i8", shape, ids);
    }
    this->Maker.write("points.npy", "<f4", "(" + std::to_string(points) + ", 3)",
      std::vector<float>(std::size_t(points) * 3));
    return tipp::openFlatMesh(this->Maker.path());
  }

  static Ids randomIds(std::size_t cells, std::int64_t points)
  {
    std::mt19937_64 random(5);
    Ids ids(3 * cells);
    for (std::int64_t& id : ids)
    {
      id = std::int64_t(random() % std::uint64_t(points));
    }
    return ids;
  }

  const tipp::test::FlatFolderMaker Maker;
};

} // namespace

TEST_P(Cells, AreReadInChunksOfAnySize)
{
  const Ids ids = randomIds(1000, 77);
  const tipp::FlatMesh mesh = this->open(ids, 77);
  for (const std::int64_t chunk : { 1, 7, 999, 1000, 1 << 20 })
  {
    const CellReader reader(mesh);
    Ids part;
    Ids all;
    for (std::int64_t first = 0; first < 1000; first += chunk)
    {
      reader.read(first, std::min(chunk, 1000 - first), part);
      all.insert(all.end(), part.begin(), part.end());
    }
    EXPECT_EQ(ids, all) << chunk;
  }
}

TEST_P(Cells, OfARangeEqualThoseOfTheWholeMesh)
{
  const Ids ids = randomIds(1000, 77);
  Ids part;
  CellReader(this->open(ids, 77)).read(300, 10, part);
  EXPECT_EQ(Ids(ids.begin() + 900, ids.begin() + 930), part);
}

TEST_P(Cells, AreTheSameForAnyNumberOfThreads)
{
  const Ids ids = randomIds(200000, 5000);
  const tipp::FlatMesh mesh = this->open(ids, 5000);
  for (const int threads : { 1, 2, 5 })
  {
    Ids all;
    CellReader(mesh, threads).read(0, 200000, all);
    EXPECT_EQ(ids, all) << threads;
  }
}

TEST_P(Cells, WithAnInvalidIdAreRefusedNamingTheFirst)
{
  for (const std::int64_t bad : { std::int64_t(77), std::int64_t(-1) })
  {
    Ids ids = randomIds(300000, 77);
    ids[3 * 200000 + 1] = bad;
    ids[3 * 299999] = bad;
    const tipp::FlatMesh mesh = this->open(ids, 77);
    for (const int threads : { 1, 4 })
    {
      const CellReader reader(mesh, threads);
      Ids part;
      expectIOError(this->Maker.path("cells.npy"),
        "cell 200000 the vertex id " + std::to_string(bad), [&] { reader.read(0, 300000, part); });
    }
  }
}

TEST_P(Cells, BeyondTheMeshAreRefused)
{
  const tipp::FlatMesh mesh = this->open(randomIds(10, 7), 7);
  Ids ids;
  EXPECT_THROW(CellReader(mesh).read(0, 11, ids), std::out_of_range);
  EXPECT_THROW(CellReader(mesh).read(5, -1, ids), std::out_of_range);
  EXPECT_THROW(CellReader(mesh).read(-1, 4, ids), std::out_of_range);
  EXPECT_THROW(CellReader(mesh).read(9, 2, ids), std::out_of_range);
}

TEST_P(Cells, OfAnEmptyMeshAreNone)
{
  Ids part{ 1, 2, 3 };
  CellReader(this->open({}, 0)).read(0, 0, part);
  EXPECT_TRUE(part.empty());
}

INSTANTIATE_TEST_SUITE_P(Ids, Cells, testing::Values("<i4", "<i8"),
  [](const auto& info) { return std::string(info.param) == "<i4" ? "Of32Bits" : "Of64Bits"; });
