// SPDX-License-Identifier: BSD-3-Clause
// A point format: binary files with x and y of each point as doubles.
#include "Files/IOError.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Points/ReadPoints.h"
#include "Triangulation/Triangulate.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

namespace
{

using namespace tipp;

class PairFile : public PointStream
{
public:
  explicit PairFile(const std::string& path)
    : Path(path)
    , File(path, std::ios::binary | std::ios::ate)
  {
    if (!this->File)
    {
      throw IOError(path, "cannot be opened; check its name.");
    }
    this->Count = std::int64_t(this->File.tellg()) / pointBytes;
    this->End = this->Count;
    this->rewind();
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const std::size_t count = std::min(most, std::size_t(this->End - this->Next));
    block.First = this->Next;
    block.XY.resize(2 * count);
    this->File.read(reinterpret_cast<char*>(block.XY.data()), std::streamsize(count) * pointBytes);
    this->Next += std::int64_t(count);
    return count > 0;
  }

  void rewind() override
  {
    this->Next = this->First;
    this->File.clear();
    this->File.seekg(this->First * pointBytes);
  }

  std::int64_t divisible() const override { return this->Count; }
  void limitTo(std::int64_t first, std::int64_t end) override
  {
    this->First = first;
    this->End = std::min(end, this->Count);
  }
  std::vector<std::string> columns() const override { return {}; }
  std::int64_t most() const override { return this->End - this->First; }
  std::string identity() const override { return this->Path; }

private:
  static constexpr std::int64_t pointBytes = 2 * sizeof(double);

  std::string Path;
  std::ifstream File;
  std::int64_t Count = 0;
  std::int64_t First = 0;
  std::int64_t End = 0;
  std::int64_t Next = 0;
};

TEST(ExtendingPointFormat, GivesTheTrianglesOfItsPoints)
{
  const test::TemporaryFolder folder;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> xy(2000);
  std::generate(xy.begin(), xy.end(), [&] { return uniform(random); });
  const std::string path = folder.file("points.pairs",
    std::string(reinterpret_cast<const char*>(xy.data()), xy.size() * sizeof(double)));

  PairFile points(path);
  const OutOfCoreStatistics made = triangulateOutOfCore(points, folder.path("mesh.tipp"));
  const Triangulation expected = triangulate(PointsView(xy.data(), xy.size() / 2, 2));
  EXPECT_EQ(1000, made.Points);
  EXPECT_EQ(std::int64_t(expected.triangleCount()), made.Triangles);
}

TEST(ExtendingPointFormat, MissingFileIsAnError)
{
  EXPECT_THROW(PairFile("/nonexistent.pairs"), IOError);
}

} // namespace
