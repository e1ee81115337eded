// SPDX-License-Identifier: BSD-3-Clause
#include "FlattenedSeries.h"
#include "MeshChecks.h"
#include "RealData.h"
#include "TemporaryFolder.h"

#include "Adcirc/AdcircGrid.h"
#include "Flat/FlatMesh.h"
#include "Flat/FlattenDataSet.h"
#include "Partitioning/PartitionMesh.h"
#include "Vtk/DataSets.h"
#include "vtkPartitionedUnstructuredReader.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// Partitions a flat mesh, and compares all owned cells and own points with the source.
void expectSame(const std::string& flat, const std::string& output, const std::string& tiling)
{
  const FlatMesh source = openFlatMesh(flat);
  PartitionOptions options;
  options.Tiling = *TilingChoice::parse(tiling);
  options.MemoryLimit = 1 << 24;
  partitionMesh(source, output, options);
  const PartitionedMesh mesh = openPartitionedMesh(output);
  const std::size_t corners = std::size_t(source.CellSize);
  std::vector<std::int64_t> cells(std::size_t(source.Cells.Tuples) * corners);
  CellReader(source).read(0, source.Cells.Tuples, cells);
  std::vector<int> seenCells(std::size_t(source.Cells.Tuples), 0);
  std::vector<int> seenPoints(std::size_t(source.Points.Tuples), 0);
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    const Piece piece = readPiece(mesh, number);
    for (std::int64_t i = 0; i < piece.Points; ++i)
    {
      const std::size_t id = std::size_t(piece.PointIds.as<std::int64_t>()[i]);
      seenPoints[id] += piece.PointGhosts.as<std::uint8_t>()[i] == 0 ? 1 : 0;
    }
    for (std::size_t i = 0; i < std::size_t(piece.Cells); ++i)
    {
      const std::size_t id = std::size_t(piece.CellIds.as<std::int64_t>()[i]);
      seenCells[id] += std::int64_t(i) < piece.OwnedCells ? 1 : 0;
      for (std::size_t corner = 0; corner < corners; ++corner)
      {
        const std::int32_t local = piece.Connectivity.as<std::int32_t>()[i * corners + corner];
        ASSERT_EQ(cells[id * corners + corner], piece.PointIds.as<std::int64_t>()[local]);
      }
    }
  }
  EXPECT_EQ(std::vector<int>(seenCells.size(), 1), seenCells);
  EXPECT_EQ(std::vector<int>(seenPoints.size(), 1), seenPoints);
}

void expectAdcircSame(const std::string& grid, const std::string& tiling)
{
  const TemporaryFolder folder;
  writeFlatMesh(folder.path("flat"), FlattenedSeries(grid).Content);
  expectSame(folder.path("flat"), folder.path("mesh"), tiling);
}

TEST(RealMeshes, TheEastCoastIsReadAsWritten)
{
  TIPP_REQUIRE_REAL_DATA(grid, "adcirc/ec95d/ec95d.grd")
  expectAdcircSame(grid, "grid:5x4");
}

TEST(RealMeshes, TheEastCoastIsReadFromAQuadtree)
{
  TIPP_REQUIRE_REAL_DATA(grid, "adcirc/ec95d/ec95d.grd")
  expectAdcircSame(grid, "quadtree:3000");
}

TEST(RealMeshes, TheSoundsOfNorthCarolinaAreReadAsWritten)
{
  TIPP_REQUIRE_REAL_DATA(grid, "adcirc/apes/fort.14")
  expectAdcircSame(grid, "quadtree:2000");
}

TEST(RealMeshes, TheOverflowIsReadWithItsTimeSteps)
{
  TIPP_REQUIRE_REAL_DATA(grid, "adcirc/internal_overflow/internal_overflow.grd")
  TIPP_REQUIRE_REAL_DATA(steps, "adcirc/internal_overflow/fort.63")
  const TemporaryFolder folder;
  const FlattenedSeries flattened(grid, { steps });
  const FlatContent& content = flattened.Content;
  writeFlatMesh(folder.path("flat"), content);
  expectSame(folder.path("flat"), folder.path("mesh"), "grid:3x3");
  const PartitionedMesh mesh = openPartitionedMesh(folder.path("mesh"));
  ASSERT_EQ(43U, mesh.Times.size());
  EXPECT_EQ(content.Times, mesh.Times);
  const FlatMesh source = openFlatMesh(folder.path("flat"));
  ASSERT_EQ(1U, source.PointSeries.size());
  PieceOptions options;
  for (const int step : { 0, 20, 42 })
  {
    options.Step = step;
    const RawArray& array = source.PointSeries[0][std::size_t(step)];
    const std::string all = contentOf(array.Path);
    for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
    {
      const Piece piece = readPiece(mesh, number, options);
      for (const Piece::Attribute& attribute : piece.Attributes)
      {
        for (std::int64_t i = 0; attribute.Description.Step == step && i < piece.Points; ++i)
        {
          const std::size_t id = std::size_t(piece.PointIds.as<std::int64_t>()[i]);
          ASSERT_EQ(0,
            std::memcmp(all.data() + array.Offset + id * array.tupleBytes(),
              attribute.Values.data() + std::size_t(i) * array.tupleBytes(), array.tupleBytes()));
        }
      }
    }
  }
}

TEST(RealMeshes, TheBracketOfTetrahedraIsReadAsWritten)
{
  TIPP_REQUIRE_REAL_DATA(path, "tets/bracket_appended_compressed.vtu")
  const TemporaryFolder folder;
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  writeFlatMesh(folder.path("flat"), flattenDataSet(data, path).Content);
  expectSame(folder.path("flat"), folder.path("mesh"), "octree:20000");
}

/// Expects the source's cells and points, identified by global ids, from
/// vtkPartitionedUnstructuredReader.
void expectReaderGives(const std::string& path, const TetrahedralMesh& source)
{
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  auto* const grid = vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
  ASSERT_NE(nullptr, grid);
  ASSERT_EQ(source.Points.size(), 3 * std::size_t(grid->GetNumberOfPoints()));
  ASSERT_EQ(source.Cells.size(), 4 * std::size_t(grid->GetNumberOfCells()));
  vtkDataArray* const pointIds = grid->GetPointData()->GetGlobalIds();
  vtkDataArray* const cellIds = grid->GetCellData()->GetGlobalIds();
  ASSERT_TRUE(pointIds && cellIds);
  const auto idIn = [](vtkDataArray* ids, vtkIdType i)
  { return std::int64_t(ids->GetComponent(i, 0)); };
  std::vector<double> points(source.Points.size(), HUGE_VAL);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    grid->GetPoint(i, &points.at(3 * std::size_t(idIn(pointIds, i))));
  }
  EXPECT_EQ(source.Points, points);
  std::vector<std::int64_t> cells(source.Cells.size(), -1);
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    ASSERT_EQ(VTK_TETRA, grid->GetCellType(i));
    grid->GetCellPoints(i, corners);
    for (vtkIdType corner = 0; corner < 4; ++corner)
    {
      cells.at(4 * std::size_t(idIn(cellIds, i)) + std::size_t(corner)) =
        idIn(pointIds, corners->GetId(corner));
    }
  }
  EXPECT_EQ(source.Cells, cells);
}

TEST(RealMeshes, TheAneurysmsTetrahedraAreReadAsWritten)
{
  TIPP_REQUIRE_REAL_DATA(path, "tets/aneurysm.xml.gz")
  const TetrahedralMesh source = readDolfin(path);
  ASSERT_EQ(37548U * 4, source.Cells.size());
  const TemporaryFolder folder;
  FlatContent content;
  content.CellSize = 4;
  content.Cells = source.Cells;
  content.Points = { "points", Scalar::Float64, 3, std::int64_t(source.Points.size() / 3), 0,
    source.Points.data(), {} };
  writeFlatMesh(folder.path("flat"), content);
  for (const std::string tiling : { "grid:2x2x3", "octree:3000" })
  {
    const std::string output = folder.path(tiling.substr(0, tiling.find(':')));
    expectSame(folder.path("flat"), output, tiling);
    expectReaderGives(output, source);
  }
}

} // namespace
