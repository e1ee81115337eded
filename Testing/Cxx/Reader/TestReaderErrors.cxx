// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"
#include "MessageCounter.h"
#include "Partitioned/PieceFile.h"
#include "Partitioning/PartitionMesh.h"
#include "ReaderTesting.h"
#include "TemporaryFolder.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkExecutive.h"

#include <atomic>
#include <cmath>
#include <fstream>
#include <thread>

namespace
{

class ReaderErrors : public testing::Test
{
protected:
  ReaderErrors()
  {
    tipp::test::writeMesh(tipp::test::makeMesh(3, 8), this->path("flat"));
    tipp::partitionMesh(tipp::openFlatMesh(this->path("flat")), this->path("stored"));
    this->Reader->SetController(nullptr);
    this->Reader->AddObserver(vtkCommand::ErrorEvent, this->Errors);
    this->Reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Others);
  }

  std::string path(const std::string& name) const { return this->Folder.path(name); }

  void expectError(const std::string& words) const
  {
    this->Reader->Update();
    EXPECT_EQ(1, this->Errors->Count);
    EXPECT_NE(std::string::npos, this->Errors->Text.find(words)) << this->Errors->Text;
    auto* const grid = vtkUnstructuredGrid::SafeDownCast(this->Reader->GetOutputDataObject(0));
    EXPECT_TRUE(!grid || grid->GetNumberOfCells() == 0);
  }

  const tipp::test::TemporaryFolder Folder;
  const vtkNew<tipp::test::MessageCounter> Errors;
  const vtkNew<tipp::test::MessageCounter> Others;
  const vtkNew<vtkPartitionedUnstructuredReader> Reader;
};

} // namespace

TEST_F(ReaderErrors, NoFileName)
{
  this->expectError("FileName is not set");
}

TEST_F(ReaderErrors, NoMeshAtThePath)
{
  this->Reader->SetFileName(this->path("none").c_str());
  this->expectError("neither a partitioned mesh");
}

TEST_F(ReaderErrors, AnInvalidTiling)
{
  this->Reader->SetFileName(this->path("flat").c_str());
  this->Reader->SetTiling("hexagons");
  this->expectError("hexagons");
}

TEST_F(ReaderErrors, BoundsThatAreNoNumbers)
{
  this->Reader->SetFileName(this->path("flat").c_str());
  this->Reader->SetBounds(0, 1, NAN, 1, 0, 1);
  this->expectError("NaN");
}

TEST_F(ReaderErrors, BoundsThatAreNoBox)
{
  this->Reader->SetFileName(this->path("flat").c_str());
  this->Reader->SetBounds(0, 1, 2, 1, 0, 1);
  this->expectError("from > to");
  this->Errors->Count = 0;
  this->Reader->SetBounds(0, 1, 0, 1, 2, 1);
  this->expectError("from > to");
}

TEST_F(ReaderErrors, ATruncatedPieceIsNamed)
{
  const std::string piece = this->path("stored/pieces/000003.vtu");
  std::filesystem::resize_file(piece, std::filesystem::file_size(piece) / 2);
  this->Reader->SetFileName(this->path("stored").c_str());
  this->expectError("000003.vtu");
}

TEST_F(ReaderErrors, AnInvalidPointIdIsNamed)
{
  const std::string cells = this->path("flat/cells.npy");
  std::fstream file(cells, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-4, std::ios::end);
  file.write("\xff\xff\xff\x7f", 4);
  file.close();
  this->Reader->SetFileName(this->path("flat").c_str());
  this->expectError("the vertex id 2147483647");
}

TEST_F(ReaderErrors, EndOnceTheMeshIsValid)
{
  this->Reader->SetFileName(this->path("none").c_str());
  this->Reader->Update();
  this->Reader->SetFileName(this->path("stored").c_str());
  this->Reader->Update();
  EXPECT_EQ(1, this->Errors->Count);
  EXPECT_EQ(2 * 7 * 7,
    vtkUnstructuredGrid::SafeDownCast(this->Reader->GetOutputDataObject(0))->GetNumberOfCells());
}

TEST_F(ReaderErrors, CanReadFileRecognizesMeshes)
{
  EXPECT_EQ(1, this->Reader->CanReadFile(this->path("flat").c_str()));
  EXPECT_EQ(1, this->Reader->CanReadFile(this->path("stored").c_str()));
  EXPECT_EQ(1, this->Reader->CanReadFile(this->path("stored/index.json").c_str()));
  EXPECT_EQ(0, this->Reader->CanReadFile(this->path("flat/cells.npy").c_str()));
  EXPECT_EQ(0, this->Reader->CanReadFile(this->path("none").c_str()));
  EXPECT_EQ(0, this->Reader->CanReadFile(nullptr));
}

/// The reader does not need the array of types, but a damaged array is still an error.
TEST_F(ReaderErrors, APieceWhoseTypesHaveChanged)
{
  const tipp::PartitionedMesh mesh = tipp::openPartitionedMesh(this->path("stored"));
  const tipp::PieceFile piece(mesh, 0);
  std::string content = tipp::test::contentOf(mesh.piecePath(0));
  content[piece.table().Offsets[piece.find(tipp::PieceRole::Types)]] ^= 1;
  std::ofstream(mesh.piecePath(0), std::ios::binary) << content;
  this->Reader->SetFileName(this->path("stored").c_str());
  this->expectError("the array types does not have its checksum");
}

TEST_F(ReaderErrors, AnAbortLeavesNoOutputAndNoError)
{
  struct Stop
  {
    int Calls = 0;
    int Made = 0;
  } stop;
  vtkNew<vtkCallbackCommand> progress;
  progress->SetClientData(&stop);
  progress->SetCallback(
    [](vtkObject* reader, unsigned long, void* data, void*)
    {
      auto* const at = static_cast<Stop*>(data);
      if (at->Made++ >= at->Calls)
      {
        static_cast<vtkAlgorithm*>(reader)->SetAbortExecute(1);
      }
    });
  this->Reader->AddObserver(vtkCommand::ProgressEvent, progress);
  this->Reader->SetBounds(0, 1, 0, 1, 0, 1);
  for (const char* const mesh : { "stored", "flat" })
  {
    this->Reader->SetFileName(this->path(mesh).c_str());
    bool isStopped = true;
    for (stop.Calls = 1; isStopped && stop.Calls < 100; ++stop.Calls)
    {
      stop.Made = 0;
      this->Reader->SetAbortExecute(0); // VTK 9.3 and later do not reset it
      this->Reader->Modified();
      this->Reader->Update();
      auto* const grid = vtkUnstructuredGrid::SafeDownCast(this->Reader->GetOutputDataObject(0));
      isStopped = !grid || grid->GetNumberOfCells() == 0;
    }
    EXPECT_FALSE(isStopped);
    EXPECT_GT(stop.Calls, 4) << mesh;
  }
  EXPECT_EQ(0, this->Errors->Count);
}

TEST_F(ReaderErrors, AMeshThatIsReplacedMeanwhileIsReadAgain)
{
  tipp::test::writeMesh(tipp::test::makeMesh(3, 12), this->path("larger"));
  std::atomic<bool> isDone{ false };
  std::thread writer(
    [&]
    {
      tipp::PartitionOptions options;
      options.Threads = 1;
      for (int i = 0; i < 40; ++i)
      {
        tipp::partitionMesh(tipp::openFlatMesh(this->path(i % 2 == 0 ? "larger" : "flat")),
          this->path("stored"), options);
      }
      isDone = true;
    });
  this->Reader->SetFileName(this->path("stored").c_str());
  int complete = 0;
  while (!isDone)
  {
    this->Reader->Modified();
    this->Reader->Update();
    const auto cells =
      vtkUnstructuredGrid::SafeDownCast(this->Reader->GetOutputDataObject(0))->GetNumberOfCells();
    complete += cells == 7 * 7 * 2 || cells == 11 * 11 * 2 ? 1 : 0;
    EXPECT_TRUE(complete > 0 || this->Errors->Count > 0) << cells;
  }
  writer.join();
  EXPECT_GT(complete, 0);
  EXPECT_EQ(std::string::npos, this->Errors->Text.find("copy or make the mesh again"))
    << this->Errors->Text;
}

TEST_F(ReaderErrors, SettingsOfArraysAreKeptWhereAMeshHasOthers)
{
  this->Reader->SetFileName(this->path("stored").c_str());
  this->Reader->GetPointDataArraySelection()->DisableArray("twice");
  this->Reader->GetPointDataArraySelection()->DisableArray("none");
  this->Reader->Update();
  vtkDataArraySelection* const arrays = this->Reader->GetPointDataArraySelection();
  EXPECT_EQ(3, arrays->GetNumberOfArrays());
  EXPECT_EQ(0, arrays->ArrayIsEnabled("twice"));
  EXPECT_EQ(1, arrays->ArrayIsEnabled("late"));
}
