// SPDX-License-Identifier: BSD-3-Clause
#include "SourceMesh.h"

#include "NpyText.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <random>

namespace tipp
{
namespace test
{
namespace
{

template <typename Value>
void writeArray(const std::string& path, const std::string& descr, const std::string& shape,
  const std::vector<Value>& values)
{
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << npyBytes(npyHeader(descr, shape), bytesOf(values));
}

std::string shapeOf(std::size_t rows, std::size_t columns)
{
  return "(" + std::to_string(rows) + ", " + std::to_string(columns) + ")";
}

} // namespace

SourceMesh makeSource(const CellSet& cells, unsigned seed)
{
  SourceMesh mesh;
  mesh.CellSize = cells.Corners;
  mesh.Components = cells.Dimension;
  const std::size_t dimension = std::size_t(cells.Dimension);
  std::map<std::vector<double>, std::int64_t> ids;
  for (std::size_t i = 0; i < cells.Coordinates.size(); i += dimension)
  {
    const auto from = cells.Coordinates.begin() + std::ptrdiff_t(i);
    const std::vector<double> point(from, from + std::ptrdiff_t(dimension));
    mesh.Cells.push_back(ids.emplace(point, std::int64_t(ids.size())).first->second);
  }
  // The point that is in no cell has the coordinates of a point in the middle.
  std::vector<std::vector<double>> points(ids.size() + 1);
  for (const auto& [point, id] : ids)
  {
    points[std::size_t(id)] = point;
  }
  points.back() = points[points.size() / 2];

  std::mt19937 random(seed);
  std::vector<std::int64_t> places(points.size());
  std::iota(places.begin(), places.end(), std::int64_t(0));
  std::shuffle(places.begin(), places.end(), random);
  mesh.Coordinates.resize(points.size() * dimension);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    std::copy(points[i].begin(), points[i].end(),
      mesh.Coordinates.begin() + std::ptrdiff_t(places[i]) * std::ptrdiff_t(dimension));
  }
  const std::size_t corners = std::size_t(mesh.CellSize);
  std::vector<std::size_t> order(mesh.Cells.size() / corners);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), random);
  std::vector<std::int64_t> shuffled;
  for (const std::size_t cell : order)
  {
    for (std::size_t corner = 0; corner < corners; ++corner)
    {
      shuffled.push_back(places[std::size_t(mesh.Cells[cell * corners + corner])]);
    }
    mesh.Labels.push_back(std::int16_t(random() % 1000));
  }
  mesh.Cells = shuffled;
  for (std::size_t i = 0; i < 2 * mesh.points(); ++i)
  {
    mesh.Values.push_back(float(random() % 100000));
  }
  return mesh;
}

void addSeries(SourceMesh& mesh, int steps)
{
  for (int step = 0; step < steps; ++step)
  {
    mesh.Times.push_back(0.1 + 600.0 * step);
    for (std::size_t i = 0; i < mesh.points(); ++i)
    {
      mesh.Series.push_back(double(i) + 1e6 * step);
    }
  }
}

void writeFlat(const SourceMesh& mesh, const std::string& folder)
{
  const std::vector<std::int32_t> cells(mesh.Cells.begin(), mesh.Cells.end());
  writeArray(
    folder + "/cells.npy", "<i4", shapeOf(mesh.cells(), std::size_t(mesh.CellSize)), cells);
  writeArray(folder + "/points.npy", "<f8", shapeOf(mesh.points(), std::size_t(mesh.Components)),
    mesh.Coordinates);
  writeArray(folder + "/point_data/value.npy", "<f4", shapeOf(mesh.points(), 2), mesh.Values);
  writeArray(
    folder + "/cell_data/label.npy", "<i2", "(" + std::to_string(mesh.cells()) + ",)", mesh.Labels);
  if (!mesh.Times.empty())
  {
    writeArray(
      folder + "/time.npy", "<f8", "(" + std::to_string(mesh.Times.size()) + ",)", mesh.Times);
    writeArray(folder + "/point_data/level.npy", "<f8", shapeOf(mesh.Times.size(), mesh.points()),
      mesh.Series);
  }
}

} // namespace test
} // namespace tipp
