// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChecks.h"
#include "MessageCounter.h"
#include "TemporaryFolder.h"

#include "Partitioned/PartitionedMesh.h"
#include "Vtk/DataSets.h"
#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPartitionedUnstructuredWriter.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace tipp;
using namespace tipp::test;

namespace
{

class PartitionedWriter : public testing::Test
{
protected:
  PartitionedWriter()
    : Source(makeSource(latticeTriangles(8, 0.3)))
  {
    writeFlat(this->Source, this->Folder.path("flat"));
    this->Writer->SetController(nullptr);
    this->Writer->SetFileName(this->Folder.path("mesh").c_str());
    this->Writer->SetInputFileName(this->Folder.path("flat").c_str());
  }

  SourceMesh Source;
  TemporaryFolder Folder;
  vtkNew<vtkPartitionedUnstructuredWriter> Writer;
};

TEST_F(PartitionedWriter, WritesAgainAfterAnAbort)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  const unsigned long observer = this->Writer->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_EQ(0, this->Writer->Write());
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path("mesh")));
  this->Writer->RemoveObserver(observer);
  this->Writer->SetAbortExecute(0); // VTK 9.3 and later do not reset it
  EXPECT_EQ(1, this->Writer->Write());
  expectHolds(this->Folder.path("mesh"), this->Source);
}

TEST_F(PartitionedWriter, RefusesToReplaceItsInput)
{
  ASSERT_EQ(1, this->Writer->Write());
  const auto before = filesOf(this->Folder.path("mesh"));
  this->Writer->SetInputFileName(this->Folder.path("mesh/pieces/000000.vtu").c_str());
  vtkNew<ErrorKeeper> errors;
  this->Writer->AddObserver(vtkCommand::ErrorEvent, errors);
  EXPECT_EQ(0, this->Writer->Write());
  EXPECT_NE(std::string::npos, errors->message().find("holds an input")) << errors->message();
  EXPECT_TRUE(before == filesOf(this->Folder.path("mesh")));
}

TEST_F(PartitionedWriter, AcceptsTheReadersOutput)
{
  ASSERT_EQ(1, this->Writer->Write());
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetController(nullptr);
  reader->SetFileName(this->Folder.path("mesh").c_str());
  reader->SetBorrowerModeToOwnedAndBorrowed();
  reader->UpdatePiece(0, 1, 1);
  this->Writer->SetInputFileName(nullptr);
  this->Writer->SetInputConnection(reader->GetOutputPort());
  this->Writer->SetFileName(this->Folder.path("again").c_str());
  ASSERT_EQ(1, this->Writer->Write());
  const PartitionedMesh again = openPartitionedMesh(this->Folder.path("again"));
  EXPECT_EQ(std::int64_t(this->Source.cells()), again.Cells);
  EXPECT_EQ(std::int64_t(this->Source.points()), again.Points);
}

TEST_F(PartitionedWriter, RefusesInvalidPointIds)
{
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(4);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const vtkIdType ids[3] = { 0, 1, 4294967299 };
  grid->InsertNextCell(VTK_TRIANGLE, 3, ids);
  vtkNew<MessageCounter> errors;
  this->Writer->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Writer->SetInputFileName(nullptr);
  this->Writer->SetInputData(grid);
  EXPECT_EQ(0, this->Writer->Write());
  EXPECT_NE(std::string::npos,
    errors->Text.find("the input: its cells refer to point 4294967299 at number 0"))
    << errors->Text;
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path("mesh")));
}

} // namespace
