// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChecks.h"
#include "TemporaryFolder.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Partitioning/PartitionMesh.h"
#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPartitionedUnstructuredWriter.h"

#include "vtkCommand.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <memory>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// Counts errors instead of printing them.
class SilentErrors : public vtkCommand
{
public:
  static SilentErrors* New() { return new SilentErrors; }
  void Execute(vtkObject*, unsigned long, void*) override { ++this->Count; }
  int Count = 0;
};

/// Tests in a folder that all ranks can read.
class PartitionRanks : public testing::Test
{
protected:
  PartitionRanks()
    : Controller(vtkMultiProcessController::GetGlobalController())
  {
    char path[4096] = {};
    if (this->isFirst())
    {
      this->Folder = std::make_unique<TemporaryFolder>();
      this->Folder->path("").copy(path, sizeof(path) - 1);
    }
    this->Controller->Broadcast(path, sizeof(path), 0);
    this->Path = path;
  }
  ~PartitionRanks() override { this->Controller->Barrier(); }

  bool isFirst() const { return this->Controller->GetLocalProcessId() == 0; }

  void write(const SourceMesh& source)
  {
    if (this->isFirst())
    {
      writeFlat(source, this->Path + "flat");
    }
    this->Controller->Barrier();
  }

  void make(const std::string& name, const std::string& tiling, bool alone)
  {
    PartitionOptions options;
    options.Tiling = *TilingChoice::parse(tiling);
    options.DuplicateBorrowers = true;
    options.ChunkCells = 37;
    options.ChunkPoints = 23;
    options.Threads = 1 + this->Controller->GetLocalProcessId() % 2;
    if (!alone || this->isFirst())
    {
      partitionMesh(openFlatMesh(this->Path + "flat"), this->Path + name, options,
        alone ? nullptr : this->Controller);
    }
    this->Controller->Barrier();
  }

  /// Runs with a Progress that stops the first rank after `calls` calls. Returns whether the run
  /// was aborted.
  bool isAborted(int calls)
  {
    PartitionOptions options;
    options.ChunkCells = 37;
    options.ChunkPoints = 23;
    options.Progress = [&calls](double) { return calls-- > 0; };
    return partitionMesh(
      openFlatMesh(this->Path + "flat"), this->Path + "mesh", options, this->Controller)
      .Aborted;
  }

  void expectSameFilesAsAlone(const std::string& tiling)
  {
    this->make("alone", tiling, true);
    this->make("together", tiling, false);
    EXPECT_TRUE(filesOf(this->Path + "alone") == filesOf(this->Path + "together"));
    this->Controller->Barrier();
  }

  vtkMultiProcessController* Controller;
  std::unique_ptr<TemporaryFolder> Folder;
  std::string Path;
};

TEST_F(PartitionRanks, MakeTheFilesOfOneRankForAGrid)
{
  this->write(makeSource(latticeTriangles(12, 0.3)));
  this->expectSameFilesAsAlone("grid:4x3");
}

TEST_F(PartitionRanks, MakeTheFilesOfOneRankForAQuadtree)
{
  this->write(makeSource(latticeTriangles(12, 0.3)));
  this->expectSameFilesAsAlone("quadtree:40");
}

TEST_F(PartitionRanks, MakeTheFilesOfOneRankInSpace)
{
  this->write(makeSource(latticeTetrahedra(4, 0.3)));
  this->expectSameFilesAsAlone("octree:100");
}

TEST_F(PartitionRanks, MayOutnumberCellsAndPieces)
{
  this->write(makeSource(latticeTriangles(1, 0)));
  this->expectSameFilesAsAlone("grid:1x2");
}

TEST_F(PartitionRanks, AllFailWithOneMessage)
{
  SourceMesh source = makeSource(latticeTriangles(12, 0.3));
  source.Cells[source.Cells.size() - 1] = 123456; // in the last rank's share
  this->write(source);
  try
  {
    this->make("mesh", "grid:2x2", false);
    ADD_FAILURE() << "no error";
  }
  catch (const IOError& error)
  {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("123456")) << error.what();
  }
  this->Controller->Barrier();
  EXPECT_FALSE(std::filesystem::exists(this->Path + "mesh"));
}

TEST_F(PartitionRanks, WriteTheCellsOfAllRanks)
{
  this->write(makeSource(latticeTriangles(12, 0.3)));
  this->make("mesh", "grid:4x3", false);
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetFileName((this->Path + "mesh").c_str());
  reader->UpdatePiece(
    this->Controller->GetLocalProcessId(), this->Controller->GetNumberOfProcesses(), 0);
  vtkNew<vtkPartitionedUnstructuredWriter> writer;
  writer->SetFileName((this->Path + "again").c_str());
  writer->SetInputDataObject(reader->GetOutputDataObject(0));
  EXPECT_EQ(1, writer->Write());
  this->Controller->Barrier();
  const PartitionedMesh again = openPartitionedMesh(this->Path + "again");
  EXPECT_EQ(288, again.Cells);
  this->Controller->Barrier();
}

TEST_F(PartitionRanks, AllFailWhenOneHasNoInput)
{
  vtkNew<vtkPartitionedUnstructuredWriter> writer;
  vtkNew<SilentErrors> errors;
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->SetFileName((this->Path + "mesh").c_str());
  vtkNew<vtkUnstructuredGrid> grid;
  if (!this->isFirst())
  {
    writer->SetInputDataObject(grid);
  }
  EXPECT_EQ(0, writer->Write());
  EXPECT_EQ(1, errors->Count);
}

TEST_F(PartitionRanks, AllStopIfTheFirstIsStopped)
{
  this->write(makeSource(latticeTriangles(12, 0.3)));
  int calls = 0;
  // Stops in every phase. The last run ends before it is stopped.
  while (this->isAborted(calls))
  {
    this->Controller->Barrier();
    EXPECT_FALSE(std::filesystem::exists(this->Path + "mesh"));
    this->Controller->Barrier();
    ++calls;
  }
  EXPECT_GT(calls, 3);
  EXPECT_TRUE(std::filesystem::exists(this->Path + "mesh"));
}

} // namespace
