// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "MeshChecks.h"
#include "TemporaryFolder.h"

#include "Flat/FlatMesh.h"
#include "Hdf/VtkHdfFile.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/WriteVtkHdf.h"
#include "Partitioning/PartitionMesh.h"
#include "Vtk/DataSets.h"

#include "vtkDataSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// Meshes whose VTKHDF files are read by the HDF5 library.
class VirtualHdf : public testing::Test
{
protected:
  PartitionedMesh make(
    const SourceMesh& source, const std::string& tiling, bool duplicate = false) const
  {
    writeFlat(source, this->Folder.path("flat"));
    PartitionOptions options;
    options.Tiling = *TilingChoice::parse(tiling);
    options.DuplicateBorrowers = duplicate;
    partitionMesh(openFlatMesh(this->Folder.path("flat")), this->Folder.path("mesh"), options);
    return openPartitionedMesh(this->Folder.path("mesh"));
  }

  /// The values of all pieces' arrays, one piece after the other.
  static std::string valuesOf(const PartitionedMesh& mesh, const std::string& name, bool ofPoints)
  {
    std::string values;
    for (std::size_t i = 0; i < mesh.Pieces.size(); ++i)
    {
      const PieceFile file(mesh, i);
      const auto found = std::find_if(file.arrays().begin(), file.arrays().end(),
        [&](const PieceArray& array)
        { return array.Name == name && array.ofPoints() == ofPoints; });
      const auto a = std::size_t(found - file.arrays().begin());
      const std::vector<std::int64_t>& starts = file.partStarts(ofPoints);
      std::string part(std::size_t(starts.back()) * found->tupleBytes(), '\0');
      file.read(a, 0, starts.size() - 1, part.data());
      values += part;
    }
    return values;
  }

  static std::string textOf(const HdfValues& values)
  {
    return { values.Bytes.begin(), values.Bytes.end() };
  }

  static std::string read(VtkHdfFile& file, const std::string& name, std::size_t step)
  {
    for (const HdfArray& array : file.arrays())
    {
      if (array.Name == name)
      {
        return textOf(file.read(array, step));
      }
    }
    ADD_FAILURE() << "no array " << name;
    return "";
  }

  void expectEqual(const PartitionedMesh& mesh, const std::string& path) const
  {
    VtkHdfFile file(path);
    EXPECT_FALSE(file.isPolyData());
    EXPECT_EQ(valuesOf(mesh, "Points", true), textOf(file.readPoints(0)));
    EXPECT_EQ(valuesOf(mesh, "GlobalPointIds", true), read(file, "GlobalPointIds", 0));
    EXPECT_EQ(valuesOf(mesh, "GlobalCellIds", false), read(file, "GlobalCellIds", 0));
    EXPECT_EQ(valuesOf(mesh, "value", true), read(file, "value", 0));
    EXPECT_EQ(valuesOf(mesh, "label", false), read(file, "label", 0));
    this->expectCells(mesh, file);
  }

  static void expectCells(const PartitionedMesh& mesh, VtkHdfFile& file)
  {
    const HdfCells cells = file.readCells(0);
    const std::string ids = valuesOf(mesh, "connectivity", false);
    std::size_t next = 0;
    std::int64_t first = 0;
    for (const PieceSummary& piece : mesh.Pieces)
    {
      const std::int64_t corners = storedCells(mesh, piece) * mesh.CellSize;
      for (std::int64_t c = 0; c < corners; ++c, ++next)
      {
        std::int32_t id = 0;
        ids.copy(reinterpret_cast<char*>(&id), sizeof(id), next * sizeof(id));
        ASSERT_EQ(first + id, cells.Ids[next]);
      }
      first += piece.Points + piece.GhostPoints;
    }
    ASSERT_EQ(next, cells.Ids.size());
    for (std::size_t cell = 0; cell < cells.Types.size(); ++cell)
    {
      ASSERT_EQ(mesh.CellSize == 3 ? 5 : 10, cells.Types[cell]);
      ASSERT_EQ(std::int64_t(cell + 1) * mesh.CellSize, cells.Offsets[cell + 1]);
    }
  }

  static std::int64_t storedCells(const PartitionedMesh& mesh, const PieceSummary& piece)
  {
    return piece.Cells + (mesh.Duplicated ? piece.BorrowedCells : 0);
  }

  static SourceMesh withSteps()
  {
    SourceMesh source = makeSource(latticeTriangles(8, 0.3));
    addSeries(source, 3);
    return source;
  }

  std::string copyOf(const PartitionedMesh& mesh) const
  {
    const std::string path = this->Folder.path("copy.vtkhdf");
    std::filesystem::remove(path);
    EXPECT_TRUE(writeVtkHdf(mesh, path, {}, [] { return false; }));
    return path;
  }

  TemporaryFolder Folder;
};

TEST_F(VirtualHdf, HasTheValuesOfThePieces)
{
  for (const bool duplicate : { false, true })
  {
    const PartitionedMesh mesh =
      this->make(makeSource(latticeTriangles(12, 0.3)), "grid:3x3", duplicate);
    this->expectEqual(mesh, mesh.vtkHdfPath());
  }
}

TEST_F(VirtualHdf, HasTheValuesOfTetrahedra)
{
  const PartitionedMesh mesh = this->make(makeSource(latticeTetrahedra(4, 0.2)), "grid:2x2x2");
  this->expectEqual(mesh, mesh.vtkHdfPath());
}

TEST_F(VirtualHdf, HasTheValuesOfManyPieces)
{
  // More than HDF5 arrays have sources here, some of them empty.
  const PartitionedMesh mesh = this->make(makeSource(latticeTriangles(10, 0.3)), "grid:20x20");
  ASSERT_TRUE(std::any_of(mesh.Pieces.begin(), mesh.Pieces.end(),
    [](const PieceSummary& piece) { return piece.Cells == 0; }));
  this->expectEqual(mesh, mesh.vtkHdfPath());
}

TEST_F(VirtualHdf, IsReadAfterTheFolderHasMoved)
{
  const PartitionedMesh mesh = this->make(makeSource(latticeTriangles(6, 0.3)), "grid:2x2");
  std::filesystem::create_directory(this->Folder.path("elsewhere"));
  const std::string moved = this->Folder.path("elsewhere/moved");
  std::filesystem::rename(mesh.Path, moved);
  this->expectEqual(openPartitionedMesh(moved), moved + "/mesh.vtkhdf");
}

TEST_F(VirtualHdf, HasTheTimeSteps)
{
  const PartitionedMesh mesh = this->make(withSteps(), "grid:2x2");
  VtkHdfFile file(mesh.vtkHdfPath());
  EXPECT_EQ(mesh.Times, file.times());
  for (std::size_t step = 0; step < 3; ++step)
  {
    EXPECT_TRUE(file.shareMesh(0, step));
    const std::string name = "level step " + std::to_string(step);
    EXPECT_EQ(valuesOf(mesh, name, true), read(file, "level", step));
    EXPECT_EQ(valuesOf(mesh, "value", true), read(file, "value", step));
  }
}

TEST_F(VirtualHdf, IsReplacedWithItsMesh)
{
  this->make(makeSource(latticeTriangles(6, 0.3)), "grid:2x2");
  const PartitionedMesh mesh = this->make(makeSource(latticeTriangles(8, 0.3)), "grid:3x1");
  this->expectEqual(mesh, mesh.vtkHdfPath());
}

TEST_F(VirtualHdf, IsCheckedBeforeTheMeshIsRead)
{
  const PartitionedMesh mesh = this->make(makeSource(latticeTriangles(6, 0.3)), "grid:2x2");
  std::filesystem::resize_file(mesh.vtkHdfPath(), 100);
  expectIOError(
    mesh.vtkHdfPath(), "100 bytes where the index says", [&] { openPartitionedMesh(mesh.Path); });
  std::filesystem::remove(mesh.vtkHdfPath());
  expectIOError(mesh.vtkHdfPath(), "missing", [&] { openPartitionedMesh(mesh.Path); });
}

TEST_F(VirtualHdf, IsNotReadIfItHasChanged)
{
  const PartitionedMesh mesh = this->make(makeSource(latticeTriangles(6, 0.3)), "grid:2x2");
  OutputFile::shared(mesh.vtkHdfPath()).write(100, "changed", 7);
  expectIOError(
    mesh.vtkHdfPath(), "does not have the checksum", [&] { readDataSet(mesh.vtkHdfPath()); });
}

TEST_F(VirtualHdf, IsNotReadWithoutAllPieces)
{
  const PartitionedMesh mesh = this->make(makeSource(latticeTriangles(6, 0.3)), "grid:2x2");
  EXPECT_EQ(mesh.Cells, readDataSet(mesh.vtkHdfPath())->GetNumberOfCells());
  std::filesystem::resize_file(mesh.piecePath(1), mesh.Pieces[1].FileBytes - 1);
  expectIOError(mesh.piecePath(1), "where the index says", [&] { readDataSet(mesh.vtkHdfPath()); });
  std::filesystem::remove(mesh.piecePath(1));
  expectIOError(mesh.piecePath(1), "missing", [&] { readDataSet(mesh.vtkHdfPath()); });
}

TEST_F(VirtualHdf, HasACopyWithoutOtherFiles)
{
  for (const bool duplicate : { false, true })
  {
    const PartitionedMesh mesh =
      this->make(makeSource(latticeTriangles(12, 0.3)), "grid:5x3", duplicate);
    const std::string copy = this->copyOf(mesh);
    const std::string pieces = mesh.Path + "/pieces";
    std::filesystem::rename(pieces, this->Folder.path("hidden"));
    VtkHdfFile whole(copy);
    EXPECT_GT(whole.cells(0), 0);
    std::filesystem::rename(this->Folder.path("hidden"), pieces);
    this->expectEqual(mesh, copy);
  }
}

TEST_F(VirtualHdf, HasACopyWithTheTimeSteps)
{
  const PartitionedMesh mesh = this->make(withSteps(), "grid:2x2");
  VtkHdfFile file(this->copyOf(mesh));
  EXPECT_EQ(mesh.Times, file.times());
  for (std::size_t step = 0; step < 3; ++step)
  {
    const std::string name = "level step " + std::to_string(step);
    EXPECT_EQ(valuesOf(mesh, name, true), read(file, "level", step));
  }
}

TEST_F(VirtualHdf, HasNoCopyOfADamagedPiece)
{
  const PartitionedMesh mesh = this->make(makeSource(latticeTriangles(6, 0.3)), "grid:2x2");
  const PieceTable table = PieceFile(mesh, 2).table();
  const OutputFile file = OutputFile::shared(mesh.piecePath(2));
  file.write(table.Offsets[0], "damaged", 7);
  expectIOError(mesh.piecePath(2), "does not have its checksum", [&] { this->copyOf(mesh); });
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path("copy.vtkhdf")));
}

TEST_F(VirtualHdf, HasNoCopyIfAborted)
{
  const PartitionedMesh mesh = this->make(makeSource(latticeTriangles(6, 0.3)), "grid:2x2");
  const std::string path = this->Folder.path("copy.vtkhdf");
  int calls = 0;
  EXPECT_FALSE(writeVtkHdf(mesh, path, {}, [&calls] { return ++calls == 3; }));
  EXPECT_FALSE(std::filesystem::exists(path));
}

} // namespace
