// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"
#include "MessageCounter.h"
#include "Partitioning/PartitionMesh.h"
#include "ReaderTesting.h"
#include "TemporaryFolder.h"

#include "vtkExecutive.h"
#include "vtkMultiProcessController.h"

#include <memory>

namespace
{

/// Meshes that the first rank writes for all ranks.
class ReaderOnRanks : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Rank = this->Controller->GetLocalProcessId();
    this->Ranks = this->Controller->GetNumberOfProcesses();
    std::vector<char> name(4096, 0);
    if (this->Rank == 0)
    {
      this->Folder = std::make_unique<tipp::test::TemporaryFolder>();
      const std::string path = this->Folder->path("");
      std::copy(path.begin(), path.end(), name.begin());
      tipp::test::writeMesh(tipp::test::makeMesh(4, 6), path + "flat");
      tipp::partitionMesh(tipp::openFlatMesh(path + "flat"), path + "stored");
    }
    this->Controller->Broadcast(name.data(), vtkIdType(name.size()), 0);
    this->Path = name.data();
  }

  // Waits, so that no rank removes files that another rank still reads.
  void TearDown() override { this->Controller->Barrier(); }

  long long sum(long long value) const
  {
    long long all = 0;
    this->Controller->AllReduce(&value, &all, 1, vtkCommunicator::SUM_OP);
    return all;
  }

  vtkMultiProcessController* const Controller = vtkMultiProcessController::GetGlobalController();
  int Rank = 0;
  int Ranks = 1;
  std::string Path;
  std::unique_ptr<tipp::test::TemporaryFolder> Folder;
};

} // namespace

TEST_F(ReaderOnRanks, EachCellIsOnOneRank)
{
  constexpr long long cells = 5 * 5 * 5 * 6;
  for (const char* const form : { "flat", "stored" })
  {
    vtkNew<vtkPartitionedUnstructuredReader> reader;
    reader->SetFileName((this->Path + form).c_str());
    reader->UpdatePiece(this->Rank, this->Ranks, 0);
    auto* const grid = vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
    long long ids = 0;
    for (const auto& [id, cell] : tipp::test::contentOf(grid).Cells)
    {
      ids += id;
    }
    EXPECT_EQ(cells, this->sum(grid->GetNumberOfCells()));
    EXPECT_EQ(cells * (cells - 1) / 2, this->sum(ids));
  }
}

TEST_F(ReaderOnRanks, AnErrorOnOneRankIsReportedOnAll)
{
  if (this->Rank == 0)
  {
    // The file's size does not change, so only the rank that reads it finds the error.
    std::fstream piece(
      this->Path + "stored/pieces/000000.vtu", std::ios::in | std::ios::out | std::ios::binary);
    piece.seekp(3000);
    piece.write("garbage garbage garbage", 23);
  }
  this->Controller->Barrier();
  vtkNew<tipp::test::MessageCounter> errors;
  vtkNew<tipp::test::MessageCounter> others;
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, others);
  reader->SetFileName((this->Path + "stored").c_str());
  reader->UpdatePiece(this->Rank, this->Ranks, 0);
  EXPECT_EQ(1, errors->Count);
  EXPECT_NE(std::string::npos, errors->Text.find("000000.vtu")) << errors->Text;
}

TEST_F(ReaderOnRanks, AMissingMeshIsReportedOnAll)
{
  vtkNew<tipp::test::MessageCounter> errors;
  vtkNew<tipp::test::MessageCounter> others;
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, others);
  reader->SetFileName((this->Path + "none").c_str());
  reader->UpdatePiece(this->Rank, this->Ranks, 0);
  EXPECT_EQ(1, errors->Count);
}
