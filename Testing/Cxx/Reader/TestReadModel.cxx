// SPDX-License-Identifier: BSD-3-Clause
#include "MessageCounter.h"
#include "ReaderTesting.h"
#include "SelafinText.h"
#include "TemporaryFolder.h"

#include "vtkDataArraySelection.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace
{

using namespace tipp::test;

class ReadModel : public testing::Test
{
protected:
  ReadModel()
  {
    this->Folder.file("a.slf", SelafinText().text());
    this->Reader->SetFileName(this->Folder.path("a.slf").c_str());
  }

  static double valueAt(vtkDataSet* mesh, const char* name, vtkIdType point)
  {
    return mesh->GetPointData()->GetArray(name)->GetTuple1(point);
  }

  TemporaryFolder Folder;
  vtkNew<vtkPartitionedUnstructuredReader> Reader;
};

} // namespace

TEST_F(ReadModel, GivesValuesAtTheRequestedTime)
{
  EXPECT_EQ(1, this->Reader->CanReadFile(this->Folder.path("a.slf").c_str()));
  this->Reader->UpdateInformation();
  vtkInformation* const information = this->Reader->GetOutputInformation(0);
  ASSERT_EQ(2, information->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
  for (const double time : { 0.0, 60.0 })
  {
    this->Reader->UpdateTimeStep(time);
    auto* const mesh = vtkDataSet::SafeDownCast(this->Reader->GetOutputDataObject(0));
    ASSERT_EQ(4, mesh->GetNumberOfPoints());
    EXPECT_EQ(2, mesh->GetNumberOfCells());
    EXPECT_EQ(1001, mesh->GetPoint(1)[0]);
    EXPECT_EQ(1 + time, valueAt(mesh, "WATER DEPTH", 0));
    EXPECT_EQ(8 + time, valueAt(mesh, "VELOCITY U", 3));
  }
}

TEST_F(ReadModel, ReadsTheChosenArraysInARange)
{
  this->Reader->UpdateInformation();
  this->Reader->GetPointDataArraySelection()->DisableArray("VELOCITY U");
  this->Reader->SetBounds(1000.75, 1001, 2000, 2000.125, 0, 0);
  this->Reader->Update();
  auto* const mesh = vtkDataSet::SafeDownCast(this->Reader->GetOutputDataObject(0));
  ASSERT_EQ(1, mesh->GetNumberOfCells());
  EXPECT_EQ(3, mesh->GetNumberOfPoints());
  EXPECT_FALSE(mesh->GetPointData()->HasArray("VELOCITY U"));
  EXPECT_EQ(2, valueAt(mesh, "WATER DEPTH", 1));
}

TEST_F(ReadModel, ReportsADamagedFile)
{
  this->Folder.file("b.slf", SelafinText().text().substr(0, 200));
  this->Reader->SetFileName(this->Folder.path("b.slf").c_str());
  const vtkNew<MessageCounter> errors;
  this->Reader->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Reader->Update();
  EXPECT_NE(std::string::npos, errors->Text.find("b.slf")) << errors->Text;
  auto* const mesh = vtkDataSet::SafeDownCast(this->Reader->GetOutputDataObject(0));
  EXPECT_EQ(0, mesh->GetNumberOfCells());
}
