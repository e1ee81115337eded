// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReaderTesting_h
#define tippReaderTesting_h

#include "Flat/FlatMesh.h"
#include "vtkPartitionedUnstructuredReader.h"

#include <gtest/gtest.h>

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// A mesh in memory with integer coordinates, small enough for exact arithmetic in 64 bits.
struct SmallMesh
{
  int CellSize = 3;
  std::vector<double> Points; ///< x, y and z per point
  std::vector<std::int64_t> Cells;

  std::size_t pointCount() const { return this->Points.size() / 3; }
  std::size_t cellCount() const { return this->Cells.size() / std::size_t(this->CellSize); }
};

/// A jittered lattice of n x n (x n) points, cut into triangles or tetrahedra. Points and cells are
/// in random order; the last point is in no cell.
inline SmallMesh makeMesh(int cellSize, int n)
{
  SmallMesh mesh;
  mesh.CellSize = cellSize;
  std::mt19937 random{ std::mt19937::result_type(n) };
  const int layers = cellSize == 3 ? 1 : n;
  std::vector<std::int64_t> number(std::size_t(n * n * layers));
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), random);
  mesh.Points.resize(3 * number.size());
  const auto at = [&](int i, int j, int k) { return number[std::size_t(i + n * (j + n * k))]; };
  const auto jitter = [&](int i) { return double(12 * i + int(random() % 5)); };
  // The paths along the cube's edges from one corner to the opposite one.
  const int paths[6][2] = { { 1, 3 }, { 1, 5 }, { 2, 3 }, { 2, 6 }, { 4, 5 }, { 4, 6 } };
  std::vector<std::vector<std::int64_t>> cells;
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        double* const p = mesh.Points.data() + 3 * at(i, j, k);
        p[0] = jitter(i);
        p[1] = jitter(j);
        p[2] = cellSize == 3 ? double(random() % 7) : jitter(k);
        const auto corner = [&](int c) { return at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)); };
        if (i + 1 == n || j + 1 == n || (cellSize == 4 && k + 1 == n))
        {
          continue;
        }
        if (cellSize == 3)
        {
          cells.push_back({ corner(0), corner(1), corner(3) });
          cells.push_back({ corner(0), corner(3), corner(2) });
        }
        for (int path = 0; cellSize == 4 && path < 6; ++path)
        {
          cells.push_back({ corner(0), corner(paths[path][0]), corner(paths[path][1]), corner(7) });
        }
      }
    }
  }
  std::shuffle(cells.begin(), cells.end(), random);
  for (const auto& cell : cells)
  {
    mesh.Cells.insert(mesh.Cells.end(), cell.begin(), cell.end());
  }
  mesh.Points.insert(mesh.Points.end(), { 17, 5, cellSize == 3 ? 0.0 : 9.0 });
  return mesh;
}

/// Writes the mesh with point data "twice" = 2 id and the time series "late" = id + 1000 step, and
/// cell data "square".
inline void writeMesh(const SmallMesh& mesh, const std::string& path)
{
  const auto points = std::int64_t(mesh.pointCount());
  const auto cells = std::int64_t(mesh.cellCount());
  std::vector<float> twice;
  std::vector<double> late;
  std::vector<std::int64_t> square;
  for (std::int64_t i = 0; i < points; ++i)
  {
    twice.push_back(float(2 * i));
  }
  for (std::int64_t i = 0; i < 2 * points; ++i)
  {
    late.push_back(double(i % points + i / points * 1000));
  }
  for (std::int64_t i = 0; i < cells; ++i)
  {
    square.push_back(i * i);
  }
  FlatContent content;
  content.CellSize = mesh.CellSize;
  content.Cells = mesh.Cells;
  content.Points = { "points", Scalar::Float64, 3, points, 0, mesh.Points.data(), {} };
  content.PointData = { { "twice", Scalar::Float32, 1, points, 0, twice.data(), {} },
    { "late", Scalar::Float64, 1, points, 2, late.data(), {} } };
  content.CellData = { { "square", Scalar::Int64, 1, cells, 0, square.data(), {} } };
  content.Times = { 0.5, 2.5 };
  writeFlatMesh(path, content);
}

/// A grid's cells and points, by global ids.
struct Content
{
  struct Point
  {
    std::array<double, 3> Place;
    int Ghost;
    std::vector<double> Data;
    bool operator==(const Point& o) const
    {
      return this->Place == o.Place && this->Ghost == o.Ghost && this->Data == o.Data;
    }
  };
  struct Cell
  {
    std::vector<std::int64_t> Corners; ///< global point ids
    int Ghost;
    std::vector<double> Data;
    bool operator==(const Cell& o) const
    {
      return this->Corners == o.Corners && this->Ghost == o.Ghost && this->Data == o.Data;
    }
  };
  std::map<std::int64_t, Point> Points;
  std::map<std::int64_t, Cell> Cells;
  bool operator==(const Content& o) const
  {
    return this->Points == o.Points && this->Cells == o.Cells;
  }
};

inline std::vector<double> dataOf(vtkDataSetAttributes* data, vtkIdType i)
{
  std::map<std::string, double> values;
  for (int a = 0; a < data->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* const array = data->GetArray(a);
    if (array != data->GetGlobalIds() && array->GetName() != std::string("vtkGhostType"))
    {
      values[array->GetName()] = array->GetTuple1(i);
    }
  }
  std::vector<double> sorted;
  for (const auto& [name, value] : values)
  {
    sorted.push_back(value);
  }
  return sorted;
}

inline int ghostOf(vtkDataSetAttributes* data, vtkIdType i)
{
  vtkDataArray* const ghosts = data->GetArray("vtkGhostType");
  return ghosts ? int(ghosts->GetTuple1(i)) : 0;
}

inline Content contentOf(vtkUnstructuredGrid* grid)
{
  Content content;
  if (grid->GetNumberOfPoints() == 0)
  {
    return content;
  }
  vtkDataArray* const pointIds = grid->GetPointData()->GetGlobalIds();
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    Content::Point point{ {}, ghostOf(grid->GetPointData(), i), dataOf(grid->GetPointData(), i) };
    grid->GetPoint(i, point.Place.data());
    const bool isNew = content.Points.emplace(std::int64_t(pointIds->GetTuple1(i)), point).second;
    EXPECT_TRUE(isNew) << "a point is there twice";
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    Content::Cell cell{ {}, ghostOf(grid->GetCellData(), i), dataOf(grid->GetCellData(), i) };
    grid->GetCellPoints(i, corners);
    for (const vtkIdType corner : *corners)
    {
      cell.Corners.push_back(std::int64_t(pointIds->GetTuple1(corner)));
    }
    const auto id = std::int64_t(grid->GetCellData()->GetGlobalIds()->GetTuple1(i));
    EXPECT_TRUE(content.Cells.emplace(id, cell).second) << "a cell is there twice";
  }
  return content;
}

} // namespace test
} // namespace tipp

#endif
