// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChecks.h"
#include "RequireDevice.h"
#include "TemporaryFolder.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Meshes/MeshFiles.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/PartitionMesh.h"

#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <set>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// A flat mesh in files, and partitioned meshes made from it.
class RoundTrip : public testing::Test
{
protected:
  void use(const SourceMesh& mesh)
  {
    this->Source = mesh;
    writeFlat(mesh, this->Folder.path("flat"));
  }

  std::string make(
    const std::string& tiling, PartitionOptions options = {}, const std::string& name = "mesh")
  {
    options.Tiling = *TilingChoice::parse(tiling);
    const std::string path = this->Folder.path(name);
    this->Statistics = partitionMesh(openFlatMesh(this->Folder.path("flat")), path, options);
    return path;
  }

  static PartitionOptions duplicating()
  {
    PartitionOptions options;
    options.DuplicateBorrowers = true;
    return options;
  }

  void expectBothHold(const std::string& tiling)
  {
    const std::string lent = this->make(tiling, {}, "lent");
    const std::string copied = this->make(tiling, duplicating(), "copied");
    expectHolds(lent, this->Source);
    expectHolds(copied, this->Source);
    const PartitionedMesh a = openPartitionedMesh(lent);
    const PartitionedMesh b = openPartitionedMesh(copied);
    ASSERT_EQ(a.Pieces.size(), b.Pieces.size());
    PieceOptions owned;
    owned.Borrowed = false;
    for (std::size_t i = 0; i < a.Pieces.size(); ++i)
    {
      EXPECT_EQ(a.Pieces[i].BorrowedCells, b.Pieces[i].BorrowedCells);
      expectEqual(readPiece(a, i), readPiece(b, i));
      expectEqual(readPiece(a, i, owned), readPiece(b, i, owned));
    }
  }

  TemporaryFolder Folder;
  SourceMesh Source;
  PartitionStatistics Statistics;
};

TEST_F(RoundTrip, KeepsTrianglesOnARegularGrid)
{
  this->use(makeSource(latticeTriangles(16, 0.3)));
  this->expectBothHold("grid:4x3");
}

TEST_F(RoundTrip, KeepsTrianglesThatTouchTheBoxes)
{
  this->use(makeSource(latticeTriangles(8, 0)));
  this->expectBothHold("grid:4x4");
}

TEST_F(RoundTrip, KeepsTrianglesLargerThanTheBoxes)
{
  this->use(makeSource(cellSoup(2, 3, 60, 3)));
  this->expectBothHold("grid:6x5");
}

TEST_F(RoundTrip, KeepsTetrahedra)
{
  this->use(makeSource(latticeTetrahedra(4, 0.2)));
  this->expectBothHold("grid:2x3x2");
}

TEST_F(RoundTrip, KeepsTetrahedraThatTouchTheBoxes)
{
  this->use(makeSource(latticeTetrahedra(4, 0)));
  this->expectBothHold("grid:2x2x4");
}

TEST_F(RoundTrip, KeepsAllInOnePiece)
{
  this->use(makeSource(latticeTriangles(6, 0.3)));
  this->expectBothHold("grid:1x1");
}

TEST_F(RoundTrip, KeepsTheLeavesOfAQuadtree)
{
  this->use(makeSource(latticeTriangles(16, 0.3)));
  this->expectBothHold("quadtree:50");
  EXPECT_GT(this->Statistics.Pieces, 4);
}

TEST_F(RoundTrip, KeepsTheLeavesOfAnOctree)
{
  this->use(makeSource(latticeTetrahedra(4, 0.2)));
  this->expectBothHold("octree:120");
  EXPECT_GT(this->Statistics.Pieces, 4);
}

TEST_F(RoundTrip, KeepsEmptyPieces)
{
  // Two squares that are far apart; the partitions between them are empty.
  CellSet cells = latticeTriangles(2, 0);
  const std::size_t half = cells.Coordinates.size();
  for (std::size_t i = 0; i < half; ++i)
  {
    cells.Coordinates.push_back(cells.Coordinates[i] + 100);
  }
  this->use(makeSource(cells));
  this->expectBothHold("grid:8x8");
}

TEST_F(RoundTrip, KeepsAMeshAtASinglePoint)
{
  SourceMesh mesh = makeSource(latticeTriangles(1, 0));
  mesh.Coordinates.assign(mesh.Coordinates.size(), 0.5);
  this->use(mesh);
  this->expectBothHold("grid:2x2");
}

TEST_F(RoundTrip, ReadsOnlySelectedArrays)
{
  this->use(makeSource(latticeTriangles(8, 0.3)));
  const PartitionedMesh mesh = openPartitionedMesh(this->make("grid:2x2"));
  PieceOptions options;
  options.Wanted = { false, true };
  const Piece piece = readPiece(mesh, 0, options);
  ASSERT_EQ(1U, piece.Attributes.size());
  EXPECT_EQ("label", piece.Attributes[0].Description.Name);
  EXPECT_LT(piece.BytesRead, readPiece(mesh, 0).BytesRead);
}

TEST_F(RoundTrip, ReadsBorrowedCellsByReferenceWithFewBytesMore)
{
  this->use(makeSource(latticeTriangles(64, 0.3)));
  const PartitionedMesh lent = openPartitionedMesh(this->make("grid:2x2", {}, "lent"));
  const PartitionedMesh copied =
    openPartitionedMesh(this->make("grid:2x2", duplicating(), "copied"));
  for (std::size_t i = 0; i < lent.Pieces.size(); ++i)
  {
    EXPECT_LT(double(readPiece(lent, i).BytesRead), 1.15 * double(readPiece(copied, i).BytesRead));
  }
}

TEST_F(RoundTrip, HasTheSameFilesForEveryLoaderChunkAndThread)
{
  this->use(makeSource(latticeTriangles(12, 0.3)));
  const auto expected = filesOf(this->make("grid:3x3", duplicating()));
  EXPECT_EQ(13U, expected.size()); // pieces, index, tables, .pvtu and .vtkhdf
  for (const Loader loader : { Loader::Auto, Loader::Direct, Loader::Fine, Loader::Mmap })
  {
    for (const std::int64_t chunk : { 1, 30, 100000 })
    {
      for (const std::int64_t m : { 1, 50, 0 })
      {
        PartitionOptions options = duplicating();
        options.Loading.Kind = loader;
        options.Loading.M = m;
        options.ChunkCells = chunk;
        options.ChunkPoints = chunk;
        options.Threads = 1 + int(chunk % 3);
        EXPECT_TRUE(filesOf(this->make("grid:3x3", options)) == expected)
          << "loader " << int(loader) << ", chunks of " << chunk << ", M " << m;
      }
    }
  }
}

TEST_F(RoundTrip, HasTheSameFilesForLittleMemory)
{
  this->use(makeSource(latticeTetrahedra(5, 0.3)));
  const auto expected = filesOf(this->make("grid:2x2x2"));
  PartitionOptions options;
  options.MemoryLimit = 1000;
  EXPECT_TRUE(filesOf(this->make("grid:2x2x2", options)) == expected);
}

TEST_F(RoundTrip, HasTheSameFilesForAnOpenCLDevice)
{
  TIPP_REQUIRE_OPENCL();
  this->use(makeSource(latticeTriangles(12, 0.3)));
  const auto expected = filesOf(this->make("grid:3x3"));
  PartitionOptions options;
  options.Device = parseDeviceChoice("opencl");
  EXPECT_TRUE(filesOf(this->make("grid:3x3", options)) == expected);
}

TEST_F(RoundTrip, IsReadByVtkThroughThePvtu)
{
  this->use(makeSource(latticeTriangles(10, 0.3)));
  for (const bool duplicate : { false, true })
  {
    PartitionOptions options;
    options.DuplicateBorrowers = duplicate;
    const PartitionedMesh mesh = openPartitionedMesh(this->make("grid:3x2", options));
    vtkNew<vtkXMLPUnstructuredGridReader> reader;
    reader->SetFileName(mesh.pvtuPath().c_str());
    reader->Update();
    vtkUnstructuredGrid* const grid = reader->GetOutput();
    auto* const cellIds = vtkIdTypeArray::SafeDownCast(grid->GetCellData()->GetGlobalIds());
    auto* const pointIds = vtkIdTypeArray::SafeDownCast(grid->GetPointData()->GetGlobalIds());
    ASSERT_NE(nullptr, cellIds);
    ASSERT_NE(nullptr, pointIds);
    std::multiset<vtkIdType> owned;
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      const vtkIdType id = cellIds->GetValue(cell);
      for (int corner = 0; corner < 3; ++corner)
      {
        const vtkIdType point = grid->GetCell(cell)->GetPointId(corner);
        ASSERT_EQ(this->Source.Cells[std::size_t(3 * id + corner)], pointIds->GetValue(point));
      }
      const auto* const ghosts = grid->GetCellGhostArray();
      ASSERT_EQ(duplicate, ghosts != nullptr);
      if (!ghosts || grid->GetCellGhostArray()->GetValue(cell) == 0)
      {
        owned.insert(id);
      }
    }
    EXPECT_EQ(this->Source.cells(), owned.size());
    EXPECT_EQ(this->Source.cells(), std::set<vtkIdType>(owned.begin(), owned.end()).size());
    for (vtkIdType point = 0; point < grid->GetNumberOfPoints(); ++point)
    {
      const double* const xyz = grid->GetPoint(point);
      const std::size_t id = std::size_t(pointIds->GetValue(point));
      ASSERT_EQ(this->Source.Coordinates[2 * id], xyz[0]);
      ASSERT_EQ(this->Source.Coordinates[2 * id + 1], xyz[1]);
    }
  }
}

TEST_F(RoundTrip, MakesAVtkGridOfAPiece)
{
  this->use(makeSource(latticeTetrahedra(4, 0.2)));
  const PartitionedMesh mesh = openPartitionedMesh(this->make("grid:2x2x1", duplicating()));
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(mesh.piecePath(3).c_str());
  reader->Update();
  vtkUnstructuredGrid* const expected = reader->GetOutput();
  const auto grid = makeGrid(readPiece(mesh, 3));
  ASSERT_EQ(expected->GetNumberOfCells(), grid->GetNumberOfCells());
  ASSERT_EQ(expected->GetNumberOfPoints(), grid->GetNumberOfPoints());
  EXPECT_EQ(VTK_TETRA, grid->GetCellType(0));
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    for (int corner = 0; corner < 4; ++corner)
    {
      ASSERT_EQ(
        expected->GetCell(cell)->GetPointId(corner), grid->GetCell(cell)->GetPointId(corner));
    }
    ASSERT_EQ(
      expected->GetCellGhostArray()->GetValue(cell), grid->GetCellGhostArray()->GetValue(cell));
  }
  EXPECT_NE(nullptr, grid->GetPointData()->GetGlobalIds());
  EXPECT_NE(nullptr, grid->GetCellData()->GetGlobalIds());
  EXPECT_NE(nullptr, grid->GetPointData()->GetArray("value"));
}

TEST_F(RoundTrip, KeepsTimeSteps)
{
  SourceMesh source = makeSource(latticeTriangles(8, 0.3));
  addSeries(source, 3);
  this->use(source);
  this->expectBothHold("grid:2x2");
  const PartitionedMesh mesh = openPartitionedMesh(this->Folder.path("lent"));
  EXPECT_EQ(source.Times, mesh.Times);
  PieceOptions options;
  options.Step = 2;
  const Piece piece = readPiece(mesh, 1, options);
  const auto found = std::find_if(piece.Attributes.begin(), piece.Attributes.end(),
    [](const Piece::Attribute& a) { return a.Description.Name == "level"; });
  ASSERT_NE(piece.Attributes.end(), found);
  for (std::size_t i = 0; i < std::size_t(piece.Points); ++i)
  {
    const auto id = double(piece.PointIds.as<std::int64_t>()[i]);
    ASSERT_EQ(id + 2e6, found->Values.as<double>()[i]);
  }
}

TEST_F(RoundTrip, ShowsVtkEachTimeStepAsAnArray)
{
  SourceMesh source = makeSource(latticeTriangles(8, 0.3));
  addSeries(source, 3);
  this->use(source);
  const PartitionedMesh mesh = openPartitionedMesh(this->make("grid:2x2"));
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName(mesh.pvtuPath().c_str());
  reader->Update();
  vtkPointData* const data = reader->GetOutput()->GetPointData();
  for (int step = 0; step < 3; ++step)
  {
    vtkDataArray* const level = data->GetArray(("level step " + std::to_string(step)).c_str());
    ASSERT_NE(nullptr, level);
    for (vtkIdType i = 0; i < level->GetNumberOfTuples(); ++i)
    {
      ASSERT_EQ(data->GetGlobalIds()->GetTuple1(i) + 1e6 * step, level->GetTuple1(i));
    }
  }
}

TEST_F(RoundTrip, RefusesReservedArrayNames)
{
  this->use(makeSource(latticeTriangles(2, 0)));
  std::filesystem::rename(this->Folder.path("flat/cell_data/label.npy"),
    this->Folder.path("flat/cell_data/GlobalCellIds.npy"));
  EXPECT_THROW(this->make("grid:2x2"), IOError);
}

TEST_F(RoundTrip, NamesAPointThatIsNotFinite)
{
  SourceMesh mesh = makeSource(latticeTriangles(2, 0));
  mesh.Coordinates[7] = std::numeric_limits<double>::quiet_NaN();
  this->use(mesh);
  try
  {
    this->make("grid:2x2");
    ADD_FAILURE() << "no error";
  }
  catch (const IOError& error)
  {
    EXPECT_NE(nullptr, std::strstr(error.what(), "point 3 ")) << error.what();
  }
  EXPECT_EQ(1U, this->Folder.fileCount());
}

TEST_F(RoundTrip, ExtentsOfTrianglesIgnoreElevationsThatAreNotFinite)
{
  const SourceMesh flat = makeSource(latticeTriangles(4, 0.2));
  SourceMesh mesh = flat;
  mesh.Components = 3;
  for (const double known : { std::numeric_limits<double>::quiet_NaN(), 7.0 })
  {
    mesh.Coordinates.clear();
    for (std::size_t i = 0; i < flat.points(); ++i)
    {
      const double z = i % 2 == 0 ? known : std::numeric_limits<double>::infinity();
      mesh.Coordinates.insert(
        mesh.Coordinates.end(), { flat.Coordinates[2 * i], flat.Coordinates[2 * i + 1], z });
    }
    this->use(mesh);
    const PartitionedMesh made = openPartitionedMesh(this->make("grid:2x2"));
    for (const PieceSummary& piece : made.Pieces)
    {
      EXPECT_EQ(piece.Extent.Min.z, known == 7 ? 7 : 0);
      EXPECT_EQ(piece.Extent.Max.z, known == 7 ? 7 : 0);
    }
  }
}

} // namespace
