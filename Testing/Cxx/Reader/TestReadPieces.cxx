// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"
#include "Partitioning/PartitionMesh.h"
#include "ReaderTesting.h"
#include "TemporaryFolder.h"

#include "vtkDataArraySelection.h"
#include "vtkInformation.h"
#include "vtkPartitionedDataSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <filesystem>

namespace
{

using tipp::test::Content;
using tipp::test::contentOf;
using tipp::test::SmallMesh;

/// A flat mesh in the plane or in space, and two partitioned ones: with and without duplicated
/// cells.
class ReadPieces : public testing::TestWithParam<int>
{
protected:
  ReadPieces()
    : Mesh(tipp::test::makeMesh(GetParam(), GetParam() == 3 ? 14 : 6))
  {
    tipp::test::writeMesh(this->Mesh, this->path("flat"));
    tipp::PartitionOptions options;
    options.Tiling = *tipp::TilingChoice::parse(this->Tiling);
    for (const bool duplicate : { false, true })
    {
      options.DuplicateBorrowers = duplicate;
      tipp::partitionMesh(tipp::openFlatMesh(this->path("flat")),
        this->path(duplicate ? "duplicate" : "reference"), options);
    }
  }

  std::string path(const std::string& name) const { return this->Folder.path(name); }

  vtkNew<vtkPartitionedUnstructuredReader> reader(const std::string& name) const
  {
    vtkNew<vtkPartitionedUnstructuredReader> reader;
    reader->SetController(nullptr);
    reader->SetFileName(this->path(name).c_str());
    reader->SetTiling(this->Tiling);
    return reader;
  }

  static vtkUnstructuredGrid* gridOf(vtkPartitionedUnstructuredReader* reader)
  {
    return vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
  }

  /// Updates the reader, and returns the content of each piece.
  static std::vector<Content> piecesOf(vtkPartitionedUnstructuredReader* reader)
  {
    reader->Update();
    std::vector<Content> pieces;
    auto* const set = vtkPartitionedDataSet::SafeDownCast(reader->GetOutputDataObject(0));
    EXPECT_NE(nullptr, set);
    for (unsigned int i = 0; set && i < set->GetNumberOfPartitions(); ++i)
    {
      pieces.push_back(contentOf(vtkUnstructuredGrid::SafeDownCast(set->GetPartition(i))));
    }
    return pieces;
  }

  /// Expects every cell and point of the mesh, as in the source.
  void expectWhole(const Content& content) const
  {
    EXPECT_EQ(this->Mesh.pointCount(), content.Points.size());
    EXPECT_EQ(this->Mesh.cellCount(), content.Cells.size());
    const auto size = std::size_t(this->Mesh.CellSize);
    for (const auto& [id, point] : content.Points)
    {
      const double* const p = this->Mesh.Points.data() + 3 * id;
      EXPECT_EQ((std::array<double, 3>{ p[0], p[1], p[2] }), point.Place);
      EXPECT_EQ(0, point.Ghost);
      EXPECT_EQ((std::vector<double>{ double(id), double(2 * id) }), point.Data);
    }
    for (const auto& [id, cell] : content.Cells)
    {
      const auto first = this->Mesh.Cells.begin() + std::ptrdiff_t(std::size_t(id) * size);
      EXPECT_EQ((std::vector<std::int64_t>{ first, first + std::ptrdiff_t(size) }), cell.Corners);
      EXPECT_EQ((std::vector<double>{ double(id * id) }), cell.Data);
    }
  }

  const char* const Tiling = "grid:3x2x2";
  const tipp::test::TemporaryFolder Folder;
  const SmallMesh Mesh;
};

const char* const forms[] = { "flat", "reference", "duplicate" };

} // namespace

TEST_P(ReadPieces, MergedAreTheWholeMesh)
{
  for (const char* const form : forms)
  {
    for (const int mode : { 0, 1 })
    {
      const auto reader = this->reader(form);
      reader->SetBorrowerMode(mode);
      reader->Update();
      this->expectWhole(contentOf(gridOf(reader)));
    }
  }
}

TEST_P(ReadPieces, OfAFlatMeshEqualThoseOfTheStoredMesh)
{
  for (const int mode : { 0, 1 })
  {
    std::vector<std::vector<Content>> read;
    for (const char* const form : forms)
    {
      const auto reader = this->reader(form);
      reader->SetMergePieces(false);
      reader->SetBorrowerMode(mode);
      read.push_back(piecesOf(reader));
    }
    EXPECT_EQ(GetParam() == 3 ? 6U : 12U, read[0].size());
    EXPECT_EQ(read[0].size(), read[1].size());
    for (std::size_t i = 0; i < read[0].size(); ++i)
    {
      EXPECT_TRUE(read[0][i] == read[1][i]) << i;
      EXPECT_TRUE(read[0][i] == read[2][i]) << i;
    }
  }
}

TEST_P(ReadPieces, OfATreeOverAFlatMeshEqualThoseOfTheStoredMesh)
{
  const char* const tiling = GetParam() == 3 ? "quadtree:40" : "octree:200";
  tipp::PartitionOptions options;
  options.Tiling = *tipp::TilingChoice::parse(tiling);
  tipp::partitionMesh(tipp::openFlatMesh(this->path("flat")), this->path("reference"), options);
  std::vector<std::vector<Content>> read;
  for (const char* const form : { "flat", "reference" })
  {
    const auto reader = this->reader(form);
    reader->SetTiling(tiling);
    reader->SetMergePieces(false);
    read.push_back(piecesOf(reader));
  }
  EXPECT_GT(read[0].size(), 4U);
  EXPECT_TRUE(read[0] == read[1]);
}

TEST_P(ReadPieces, OfManyRequestsHaveEachCellOnce)
{
  for (const char* const form : forms)
  {
    for (const int pieces : { 1, 2, 5, 40 })
    {
      std::map<std::int64_t, int> seen;
      for (int piece = 0; piece < pieces; ++piece)
      {
        const auto reader = this->reader(form);
        reader->UpdatePiece(piece, pieces, 0);
        for (const auto& [id, cell] : contentOf(gridOf(reader)).Cells)
        {
          ++seen[id];
        }
      }
      EXPECT_EQ(this->Mesh.cellCount(), seen.size());
      EXPECT_TRUE(
        std::all_of(seen.begin(), seen.end(), [](const auto& one) { return one.second == 1; }));
    }
  }
}

TEST_P(ReadPieces, WithGhostLevelsHaveBorrowedCells)
{
  const auto reader = this->reader("reference");
  // The first partition owns all cells that it meets, and so borrows none. The last one borrows.
  reader->UpdatePiece(5, 6, 1);
  int ghosts = 0;
  for (const auto& [id, cell] : contentOf(gridOf(reader)).Cells)
  {
    ghosts += cell.Ghost != 0;
  }
  EXPECT_GT(ghosts, 0);
}

TEST_P(ReadPieces, AreOfTheRequestedTime)
{
  for (const char* const form : forms)
  {
    const auto reader = this->reader(form);
    reader->UpdateInformation();
    vtkInformation* const info = reader->GetOutputInformation(0);
    EXPECT_EQ(2, info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
    const std::pair<double, double> times[] = { { -1, 0 }, { 0.5, 0 }, { 2.4, 0 }, { 2.5, 1000 },
      { 9, 1000 } };
    for (const auto& [time, added] : times)
    {
      reader->UpdateTimeStep(time);
      vtkUnstructuredGrid* const grid = gridOf(reader);
      EXPECT_EQ(added,
        grid->GetPointData()->GetArray("late")->GetTuple1(3) -
          grid->GetPointData()->GetGlobalIds()->GetTuple1(3));
    }
  }
}

TEST_P(ReadPieces, HaveOnlyTheSelectedArrays)
{
  for (const char* const form : forms)
  {
    const auto reader = this->reader(form);
    reader->UpdateInformation();
    EXPECT_EQ(2, reader->GetPointDataArraySelection()->GetNumberOfArrays());
    reader->GetPointDataArraySelection()->DisableArray("late");
    reader->GetCellDataArraySelection()->DisableAllArrays();
    reader->Update();
    EXPECT_NE(nullptr, gridOf(reader)->GetPointData()->GetArray("twice"));
    EXPECT_EQ(nullptr, gridOf(reader)->GetPointData()->GetArray("late"));
    EXPECT_EQ(nullptr, gridOf(reader)->GetCellData()->GetArray("square"));
    reader->GetPointDataArraySelection()->EnableArray("late");
    reader->Update();
    EXPECT_NE(nullptr, gridOf(reader)->GetPointData()->GetArray("late"));
  }
}

TEST_P(ReadPieces, InTheCacheAreNotReadAgain)
{
  const auto reader = this->reader("reference");
  reader->SetCacheSize(100);
  reader->Update();
  EXPECT_EQ(GetParam() == 3 ? 6 : 12, reader->GetNumberOfPiecesRead());
  EXPECT_GT(reader->GetNumberOfBytesRead(), 0);
  reader->Modified();
  reader->Update();
  EXPECT_EQ(0, reader->GetNumberOfPiecesRead());
  this->expectWhole(contentOf(gridOf(reader)));
}

TEST_P(ReadPieces, AreTheSameFromTheCache)
{
  for (const char* const form : forms)
  {
    std::vector<Content> contents;
    for (const int cache : { 0, 2, 100 })
    {
      const auto reader = this->reader(form);
      reader->SetCacheSize(cache);
      reader->UpdatePiece(1, 6, 1);
      contents.push_back(contentOf(gridOf(reader)));
      reader->Modified();
      reader->UpdatePiece(1, 6, 1);
      contents.push_back(contentOf(gridOf(reader)));
      EXPECT_TRUE(cache == 0 || reader->GetNumberOfPiecesRead() == 0) << cache;
    }
    for (const Content& content : contents)
    {
      EXPECT_TRUE(contents[0] == content);
    }
  }
}

TEST_P(ReadPieces, AreReadAgainIfTheFileHasChanged)
{
  const auto reader = this->reader("flat");
  reader->SetCacheSize(100);
  reader->Update();
  namespace fs = std::filesystem;
  fs::rename(this->path("flat/point_data/twice.npy"), this->path("flat/point_data/thrice.npy"));
  reader->Modified();
  reader->Update();
  EXPECT_EQ(nullptr, gridOf(reader)->GetPointData()->GetArray("twice"));
  EXPECT_NE(nullptr, gridOf(reader)->GetPointData()->GetArray("thrice"));
  fs::last_write_time(this->path("flat/time.npy"), fs::file_time_type::clock::now());
  reader->Modified();
  reader->Update();
  EXPECT_GT(reader->GetNumberOfPiecesRead(), 0);
}

TEST_P(ReadPieces, AreTheSameForEveryNumberOfThreads)
{
  for (const int threads : { 1, 3 })
  {
    const auto reader = this->reader("flat");
    reader->SetNumberOfThreads(threads);
    reader->Update();
    this->expectWhole(contentOf(gridOf(reader)));
  }
}

TEST_P(ReadPieces, AreReadWithinASmallMemoryLimit)
{
  const auto reader = this->reader("flat");
  reader->SetMemoryLimit(1000);
  reader->Update();
  this->expectWhole(contentOf(gridOf(reader)));
}

INSTANTIATE_TEST_SUITE_P(Dimension, ReadPieces, testing::Values(3, 4),
  [](const auto& info) { return info.param == 3 ? "Triangles" : "Tetrahedra"; });
