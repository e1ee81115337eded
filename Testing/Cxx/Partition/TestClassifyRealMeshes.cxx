// SPDX-License-Identifier: BSD-3-Clause
// The owner and the borrowers of each cell of real meshes, compared with a test of all partitions.
#include "CellSets.h"
#include "ExactClipping.h"
#include "RealData.h"
#include "RequireDevice.h"

#include "Vtk/DataSets.h"

#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

using tipp::Box3;
using tipp::BoxTiling;
using tipp::Membership;
using tipp::Point3;

namespace
{

CellSet readTetrahedra(const std::string& path)
{
  const auto grid = tipp::readDataSet(path);
  CellSet cells;
  cells.Dimension = 3;
  cells.Corners = 4;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    grid->GetCellPoints(cell, corners);
    for (vtkIdType i = 0; i < 4; ++i)
    {
      double p[3];
      grid->GetPoint(corners->GetId(i), p);
      cells.Coordinates.insert(cells.Coordinates.end(), p, p + 3);
    }
  }
  return cells;
}

CellSet readAneurysm(const std::string& path)
{
  const tipp::test::TetrahedralMesh mesh = tipp::test::readDolfin(path);
  CellSet cells;
  cells.Dimension = 3;
  cells.Corners = 4;
  for (const std::int64_t id : mesh.Cells)
  {
    const auto point = mesh.Points.begin() + 3 * id;
    cells.Coordinates.insert(cells.Coordinates.end(), point, point + 3);
  }
  return cells;
}

CellSet readTriangles(const std::string& path)
{
  const tipp::test::AdcircMesh mesh = tipp::test::readAdcirc(path);
  CellSet cells;
  for (const auto& element : mesh.Elements)
  {
    for (const auto vertex : element)
    {
      const auto place = 2 * static_cast<std::size_t>(vertex);
      cells.Coordinates.insert(
        cells.Coordinates.end(), { mesh.Nodes[place], mesh.Nodes[place + 1] });
    }
  }
  return cells;
}

// Every `step`-th of the cells whose bounding boxes meet several boxes.
CellSet borderCells(const CellSet& cells, const BoxTiling& tiling, std::size_t step)
{
  CellSet result = { cells.Dimension, cells.Corners, {} };
  const auto stride = static_cast<std::ptrdiff_t>(cells.Dimension) * cells.Corners;
  std::size_t found = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const auto begin = cells.Coordinates.begin() + static_cast<std::ptrdiff_t>(i) * stride;
    const CellSet alone = { cells.Dimension, cells.Corners, { begin, begin + stride } };
    const Box3 bounds = alone.bounds();
    int boxes = 0;
    for (std::int64_t id = 0; id < tiling.count(); ++id)
    {
      bool meets = true;
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(cells.Dimension); ++axis)
      {
        meets = meets && bounds.Min[axis] <= tiling.box(id).Max[axis] &&
          tiling.box(id).Min[axis] <= bounds.Max[axis];
      }
      boxes += meets ? 1 : 0;
    }
    if (boxes > 1 && found++ % step == 0)
    {
      result.Coordinates.insert(result.Coordinates.end(), begin, begin + stride);
    }
  }
  return result;
}

Membership classify(const CellSet& cells, const BoxTiling& tiling, tipp::Device device)
{
  tipp::ClassifyOptions options;
  options.Device.Kind = device;
  options.Threads = 2;
  return tipp::classifyCells(cells.view(), tiling, options);
}

void expectExactAtBorders(const CellSet& cells, const BoxTiling& tiling, std::size_t step)
{
  const CellSet sample = borderCells(cells, tiling, step);
  ASSERT_GT(sample.size(), 50u);
  expectEqual(bruteForce(sample, tiling), classify(sample, tiling, tipp::Device::OpenMP));
}

void expectSameOnDevice(const CellSet& cells, const BoxTiling& tiling)
{
  expectEqual(
    classify(cells, tiling, tipp::Device::OpenMP), classify(cells, tiling, tipp::Device::OpenCL));
}

/// A grid and a tree.
std::vector<BoxTiling> tilingsOf(const CellSet& cells)
{
  const Box3 domain = cells.bounds();
  return { BoxTiling::grid(cells.Dimension, domain, { 4, 4, 4 }),
    randomTree(cells.Dimension, domain, 3, 1) };
}

void expectExactAtBorders(const CellSet& cells, std::size_t step)
{
  for (const BoxTiling& tiling : tilingsOf(cells))
  {
    expectExactAtBorders(cells, tiling, step);
  }
}

void expectSameOnDevice(const CellSet& cells)
{
  for (const BoxTiling& tiling : tilingsOf(cells))
  {
    expectSameOnDevice(cells, tiling);
  }
}

} // namespace

TEST(ClassifyRealMeshes, TheBracketsTetrahedra)
{
  TIPP_REQUIRE_REAL_DATA(path, "tets/bracket_appended_compressed.vtu");
  const CellSet cells = readTetrahedra(path);
  ASSERT_EQ(cells.size(), 206208u);
  expectExactAtBorders(cells, 100);
}

TEST(ClassifyRealMeshes, TheAneurysmsTetrahedra)
{
  TIPP_REQUIRE_REAL_DATA(path, "tets/aneurysm.xml.gz");
  const CellSet cells = readAneurysm(path);
  ASSERT_EQ(cells.size(), 37548u);
  expectExactAtBorders(cells, 50);
}

TEST(ClassifyRealMeshes, TheEastCoastsTriangles)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/ec95d/ec95d.grd");
  const CellSet cells = readTriangles(path);
  expectExactAtBorders(cells, 5);
}

TEST(ClassifyRealMeshes, TheBracketsTetrahedraOnADevice)
{
  TIPP_REQUIRE_REAL_DATA(path, "tets/bracket_appended_compressed.vtu");
  TIPP_REQUIRE_OPENCL();
  expectSameOnDevice(readTetrahedra(path));
}

TEST(ClassifyRealMeshes, TheAneurysmsTetrahedraOnADevice)
{
  TIPP_REQUIRE_REAL_DATA(path, "tets/aneurysm.xml.gz");
  TIPP_REQUIRE_OPENCL();
  expectSameOnDevice(readAneurysm(path));
}

TEST(ClassifyRealMeshes, TheEastCoastsTrianglesOnADevice)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/ec95d/ec95d.grd");
  TIPP_REQUIRE_OPENCL();
  expectSameOnDevice(readTriangles(path));
}
