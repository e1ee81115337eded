// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResumeTesting_h
#define tippResumeTesting_h

#include "OutOfCoreTesting.h"

#include "ExpectIOError.h"
#include "Npy/NpyFile.h"
#include "OutOfCore/OutOfCoreTetrahedralization.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Triangles of points in the plane.
struct Plane
{
  using Options = OutOfCoreOptions;
  using Statistics = OutOfCoreStatistics;

  static std::vector<std::string> kinds()
  {
    return { "uniform", "clustered", "duplicates", "lattice", "two-clusters" };
  }
  static void write(
    const std::string& path, const std::string& kind, std::size_t count, std::uint64_t seed)
  {
    writePoints(path, makePointSet(kind, count, seed));
  }
  static Options options()
  {
    Options options;
    options.PiecePoints = 150;
    options.PartitionPoints = 40;
    return options;
  }
  static Statistics run(const std::string& points, const std::string& mesh, const Options& options)
  {
    return triangulateOutOfCore(*openPointStream({ points }), mesh, options);
  }
  static std::int64_t cells(const Statistics& made) { return made.Triangles; }
  static std::uint64_t sum(const Statistics& made) { return made.TriangleSum; }
};

/// Tetrahedra of points in space.
struct Space
{
  using Options = OutOfCoreOptions3;
  using Statistics = OutOfCoreStatistics3;

  static std::vector<std::string> kinds() { return { "uniform", "clustered", "duplicates" }; }
  /// The duplicates are on a lattice.
  static void write(
    const std::string& path, const std::string& kind, std::size_t count, std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    const auto draw = [&] { return double(random() >> 40) * 0x1p-24; };
    std::vector<double> xyz;
    for (std::size_t i = 0; i < 3 * count; ++i)
    {
      const double x = draw();
      const std::size_t cluster = i / 3 % 5;
      const std::size_t axis = i % 3;
      xyz.push_back(kind == "duplicates" ? std::floor(12 * x)
          : kind == "clustered"          ? x + 4 * double(cluster * (axis + 1) % 5)
                                         : x);
    }
    NpyWriter writer(path, "<f8", { std::int64_t(count), 3 });
    writer.write(xyz.data(), xyz.size() * sizeof(double));
    writer.close();
  }
  static Options options()
  {
    Options options;
    options.PiecePoints = 150;
    options.MemoryLimit = 1 << 20; // too little for one piece
    return options;
  }
  static Statistics run(const std::string& points, const std::string& mesh, const Options& options)
  {
    PointOptions inSpace;
    inSpace.InSpace = true;
    return tetrahedralizeOutOfCore(*openPointStream({ points }, inSpace), mesh, options);
  }
  static std::int64_t cells(const Statistics& made) { return made.Tetrahedra; }
  static std::uint64_t sum(const Statistics&) { return 0; }
};

template <typename Engine>
class OutOfCoreResume : public testing::Test
{
protected:
  OutOfCoreResume() { this->Options.Threads = 2; }

  typename Engine::Statistics run() const
  {
    return Engine::run(
      this->Folder.path("points.npy"), this->Folder.path("mesh.tipp"), this->Options);
  }

  void makePoints(const std::string& kind, std::size_t count = 2500, std::uint64_t seed = 1) const
  {
    Engine::write(this->Folder.path("points.npy"), kind, count, seed);
  }

  std::map<std::string, std::string> files() const
  {
    return filesOf(this->Folder.path("mesh.tipp"));
  }

  typename Engine::Options Options = Engine::options();
  TemporaryFolder Folder;
};

using Engines = testing::Types<Plane, Space>;

} // namespace test
} // namespace tipp

#endif
