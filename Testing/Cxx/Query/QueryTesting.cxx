// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Flat/FlatMesh.h"
#include "Partitioning/PartitionMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>

namespace tipp
{
namespace test
{
namespace
{

struct Kept
{
  SourceMesh Source;
  std::vector<double> Points;
  std::vector<std::int64_t> Ids;
  std::vector<std::int64_t> PointIds;
};

StoredArray described(const char* name, bool ofPoints, Scalar type, int components, int step = -1)
{
  return { name, ofPoints, type, components, step };
}

} // namespace

Point3 pointOf(const SourceMesh& source, std::int64_t id)
{
  const double* p = source.Coordinates.data() + id * source.Components;
  return { p[0], p[1], source.Components == 3 ? p[2] : 0 };
}

SourceMesh withHoles(SourceMesh source, std::int64_t every)
{
  SourceMesh result = source;
  result.Cells.clear();
  result.Labels.clear();
  for (std::size_t cell = 0; cell < source.cells(); ++cell)
  {
    if (std::int64_t(cell) % every != 0)
    {
      const auto corners = std::ptrdiff_t(source.CellSize);
      const auto first = source.Cells.begin() + std::ptrdiff_t(cell) * corners;
      result.Cells.insert(result.Cells.end(), first, first + corners);
      result.Labels.push_back(source.Labels[cell]);
    }
  }
  return result;
}

void withEachMesh(const SourceMesh& source, const std::function<void(const ResidentMesh&)>& work)
{
  const bool inSpace = source.CellSize == 4;
  ResidentOptions options;
  options.Threads = 3;
  work(ResidentMesh(inMemory(source), options));
  for (const char* const tiling :
    { inSpace ? "grid:2x2x2" : "grid:4x4", inSpace ? "octree:60" : "quadtree:30", "grid:5x1" })
  {
    SCOPED_TRACE(tiling);
    const TemporaryFolder folder;
    store(source, folder.path("mesh.tipp"), tiling, tiling[0] == 'q');
    options.MemoryLimit = tiling[0] == 'g' ? 60000 : 1 << 30;
    work(ResidentMesh(folder.path("mesh.tipp"), options));
  }
}

MeshPart inMemory(const SourceMesh& source, int step, int part, int parts)
{
  const auto kept = std::make_shared<Kept>();
  const auto corners = std::size_t(source.CellSize);
  kept->Source = source;
  if (parts > 1)
  {
    kept->Source.Cells.clear();
    kept->Source.Labels.clear();
    for (std::size_t cell = std::size_t(part); cell < source.cells(); cell += std::size_t(parts))
    {
      kept->Ids.push_back(std::int64_t(cell));
      kept->Source.Labels.push_back(source.Labels[cell]);
      for (std::size_t i = 0; i < corners; ++i)
      {
        kept->Source.Cells.push_back(source.Cells[cell * corners + i]);
      }
    }
  }
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    kept->PointIds.push_back(std::int64_t(i));
    const Point3 p = pointOf(source, std::int64_t(i));
    kept->Points.insert(kept->Points.end(), { p.x, p.y, p.z });
  }
  MeshPart result;
  result.Mesh.Points = kept->Points.data();
  result.Mesh.PointCount = std::int64_t(source.points());
  result.Mesh.Ids = kept->Source.Cells.data();
  result.Mesh.Wide = true;
  result.Mesh.Cells = result.OwnedCells = std::int64_t(kept->Source.cells());
  result.Mesh.Dimension = source.CellSize - 1;
  result.CellIds = parts > 1 ? kept->Ids.data() : nullptr;
  result.PointIds = parts > 1 ? kept->PointIds.data() : nullptr;
  result.Arrays.push_back(
    { described("value", true, Scalar::Float32, 2), kept->Source.Values.data() });
  result.Arrays.push_back(
    { described("label", false, Scalar::Int16, 1), kept->Source.Labels.data() });
  if (!source.Series.empty())
  {
    result.Arrays.push_back({ described("level", true, Scalar::Float64, 1, step),
      kept->Source.Series.data() + std::size_t(step) * source.points() });
  }
  result.Keeps = kept;
  return result;
}

void store(
  const SourceMesh& source, const std::string& path, const std::string& tiling, bool duplicate)
{
  const TemporaryFolder folder;
  writeFlat(source, folder.path("flat"));
  PartitionOptions options;
  options.Tiling = *TilingChoice::parse(tiling);
  options.DuplicateBorrowers = duplicate;
  partitionMesh(openFlatMesh(folder.path("flat")), path, options);
}

std::vector<Point3> pointsAround(const SourceMesh& source, int atRandom)
{
  std::vector<Point3> points;
  Point3 low = pointOf(source, 0);
  Point3 high = low;
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    const Point3 p = pointOf(source, std::int64_t(i));
    points.push_back(p);
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
  }
  for (std::size_t i = 0; i + 1 < source.Cells.size(); i += 2)
  {
    const Point3 a = pointOf(source, source.Cells[i]);
    const Point3 b = pointOf(source, source.Cells[i + 1]);
    points.push_back({ (a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2 });
  }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-0.1, 1.1);
  const auto between = [](double from, double to, double s) { return from + s * (to - from); };
  for (int i = 0; i < atRandom; ++i)
  {
    Point3 p{ between(low.x, high.x, share(random)), between(low.y, high.y, share(random)),
      between(low.z, high.z, share(random)) };
    if (i % 3 == 0)
    {
      p.x = between(low.x, high.x, 0.25 * double(i / 3 % 5));
    }
    if (i % 5 == 0)
    {
      p.y = between(low.y, high.y, 0.25 * double(i / 5 % 5));
    }
    points.push_back(p);
  }
  return points;
}

void expectEqual(const MeshAnswer& expected, const MeshAnswer& answer)
{
  EXPECT_EQ(expected.Cells, answer.Cells);
  EXPECT_EQ(expected.Weights, answer.Weights);
  ASSERT_EQ(expected.Arrays.size(), answer.Arrays.size());
  for (std::size_t i = 0; i < answer.Arrays.size(); ++i)
  {
    const MeshAnswer::Array& a = expected.Arrays[i];
    const MeshAnswer::Array& b = answer.Arrays[i];
    EXPECT_EQ(a.Name, b.Name);
    EXPECT_EQ(a.Type, b.Type);
    EXPECT_EQ(a.Components, b.Components);
    ASSERT_EQ(a.Values.size(), b.Values.size());
    EXPECT_EQ(0, std::memcmp(a.Values.data(), b.Values.data(), b.Values.size())) << b.Name;
  }
}

} // namespace test
} // namespace tipp
