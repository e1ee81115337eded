// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPOutOfCoreDelaunay2D in a pipeline.
#include "OutOfCoreTesting.h"

#include "Npy/NpyFile.h"
#include "Pipeline/FilterPipeline.h"
#include "Statistics/RunStatistics.h"
#include "vtkPartitionedUnstructuredReader.h"
#include "vtkTIPPOutOfCoreDelaunay2D.h"

#include "vtkCallbackCommand.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

class OutOfCoreFilter : public testing::Test
{
protected:
  OutOfCoreFilter()
  {
    writePoints(this->Folder.path("points.npy"), this->Points);
    this->Filter->AddInputFileName(this->Folder.path("points.npy").c_str());
    this->Filter->SetFileName(this->Folder.path("mesh.tipp").c_str());
    this->Filter->SetNumberOfPartitions(4, 3);
    this->Filter->SetNumberOfThreads(2);
    this->Events->SetClientData(this);
    this->Events->SetCallback([](vtkObject*, unsigned long event, void* test, void* text)
      { static_cast<OutOfCoreFilter*>(test)->hear(event, static_cast<const char*>(text)); });
    this->Filter->AddObserver(vtkCommand::ErrorEvent, this->Events);
    this->Filter->AddObserver(vtkCommand::WarningEvent, this->Events);
    this->Filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Events);
  }

  void hear(unsigned long event, const char* text)
  {
    (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings) += text;
  }

  /// The error message of an update that fails and has no output.
  std::string failure()
  {
    this->Filter->Update();
    EXPECT_EQ(0, this->Filter->GetOutput()->GetNumberOfRows());
    EXPECT_FALSE(fs::exists(this->Folder.path("mesh.tipp")));
    return this->Errors;
  }

  double total(const char* name) const
  {
    vtkDataArray* const array = this->Filter->GetStatistics()->GetFieldData()->GetArray(name);
    return array && array->GetNumberOfTuples() == 1 ? array->GetTuple1(0) : -1;
  }

  const Coordinates Points = makePointSet("duplicates", 3000);
  TemporaryFolder Folder;
  vtkNew<vtkTIPPOutOfCoreDelaunay2D> Filter;
  vtkNew<vtkCallbackCommand> Events;
  std::string Errors;
  std::string Warnings;
};

TEST_F(OutOfCoreFilter, TheConnectedReaderReadsTheMesh)
{
  this->Filter->Update();
  EXPECT_EQ("", this->Errors + this->Warnings);
  const Reference expected = reference(this->Points);
  EXPECT_TRUE(meshMatches(this->Folder.path("mesh.tipp"), this->Points, expected));
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetController(nullptr);
  reader->SetFileName(this->Filter->GetFileName());
  reader->SetMergePieces(true);
  reader->Update();
  EXPECT_EQ(vtkIdType(expected.Mesh.size()),
    vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0))->GetNumberOfCells());
}

TEST_F(OutOfCoreFilter, TheConnectedReaderReadsNeighborIds)
{
  this->Filter->GenerateNeighborIdsOn();
  this->Filter->Update();
  EXPECT_EQ(5, this->Filter->GetStatistics()->GetNumberOfRows());
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetController(nullptr);
  reader->SetFileName(this->Filter->GetFileName());
  reader->SetMergePieces(true);
  reader->Update();
  vtkDataArray* const neighbors = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0))
                                    ->GetCellData()
                                    ->GetArray("NeighborIds");
  ASSERT_TRUE(neighbors != nullptr);
  EXPECT_EQ(3, neighbors->GetNumberOfComponents());
  EXPECT_EQ(-1,
    std::min({ neighbors->GetRange(0)[0], neighbors->GetRange(1)[0], neighbors->GetRange(2)[0] }));
}

TEST_F(OutOfCoreFilter, HasTheRunsStatistics)
{
  this->Filter->Update();
  EXPECT_EQ(3000, this->total("Points"));
  EXPECT_EQ(double(reference(this->Points).Mesh.size()), this->total("Triangles"));
  EXPECT_GT(this->total("DuplicatePoints"), 100);
  EXPECT_EQ(0, this->total("RejectedPoints"));
  EXPECT_EQ(12, this->total("Pieces"));
  EXPECT_EQ(2, this->total("Threads"));
  EXPECT_EQ(0, this->total("Resumed"));
  EXPECT_EQ(-1, this->total("TriangleSum"));
  vtkTable* const table = this->Filter->GetStatistics();
  ASSERT_EQ(4, table->GetNumberOfRows());
  EXPECT_EQ("survey", table->GetValueByName(0, "Phase").ToString());
  EXPECT_LT(0, table->GetValueByName(2, "Seconds").ToDouble());
}

TEST_F(OutOfCoreFilter, CountsWithoutWriting)
{
  this->Filter->CountOnlyOn();
  this->Filter->Update();
  EXPECT_EQ(double(reference(this->Points).Mesh.size()), this->total("Triangles"));
  EXPECT_LT(0, this->total("TriangleSum"));
  EXPECT_EQ(1U, this->Folder.fileCount());
}

TEST_F(OutOfCoreFilter, ResumesAfterAnAbort)
{
  this->Filter->SetNumberOfPartitions(0, 0);
  this->Filter->SetMemoryLimit(1);
  this->Filter->Update();
  const auto expected = filesOf(this->Folder.path("mesh.tipp"));
  fs::remove_all(this->Folder.path("mesh.tipp"));
  static std::thread::id thread;
  thread = std::this_thread::get_id();
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      EXPECT_EQ(thread, std::this_thread::get_id());
      auto* const filter = static_cast<vtkAlgorithm*>(caller);
      filter->SetAbortExecute(filter->GetProgress() > 0.3 ? 1 : 0);
    });
  const unsigned long observer = this->Filter->AddObserver(vtkCommand::ProgressEvent, abort);
  this->Filter->Modified();
  EXPECT_EQ("", this->failure());
  this->Filter->RemoveObserver(observer);
  this->Filter->SetAbortExecute(0);
  this->Filter->ResumeOn();
  this->Filter->Update();
  EXPECT_EQ(1, this->total("Resumed"));
  EXPECT_TRUE(expected == filesOf(this->Folder.path("mesh.tipp")));
}

TEST_F(OutOfCoreFilter, ReadsColumnsByNameAndFilesInOrder)
{
  this->Filter->SetInputFileName(
    this->Folder.file("a.csv", "height,south,west\n1,0,0\n2,0,4\n").c_str());
  this->Filter->AddInputFileName(this->Folder.file("b.csv", "height,south,west\n3,9,0\n").c_str());
  EXPECT_EQ(2, this->Filter->GetNumberOfInputFileNames());
  EXPECT_EQ(this->Folder.path("b.csv"), this->Filter->GetInputFileName(1));
  EXPECT_EQ(nullptr, this->Filter->GetInputFileName(2));
  this->Filter->SetXColumn("west");
  this->Filter->SetYColumn("south");
  this->Filter->GenerateRepresentativeIdsOn();
  this->Filter->Update();
  EXPECT_EQ("", this->Errors);
  EXPECT_EQ(1, this->total("Triangles"));
  const PartitionedMesh mesh = openPartitionedMesh(this->Folder.path("mesh.tipp"));
  EXPECT_EQ((std::array<double, 6>{ 0, 4, 0, 9, 0, 0 }), vtkBoundsOf(mesh.Domain));
  ASSERT_EQ(2U, mesh.Arrays.size());
  EXPECT_EQ("height", mesh.Arrays[0].Name);
  EXPECT_EQ("RepresentativePointId", mesh.Arrays[1].Name);
}

TEST_F(OutOfCoreFilter, PutsSpilledPointsIntoTheScratchFolder)
{
  this->Filter->SetScratchFolder(this->Folder.file("file", "").c_str());
  EXPECT_NE(std::string::npos, this->failure().find("cannot be made"));
  this->Filter->SetScratchFolder(this->Folder.path("scratch").c_str());
  this->Filter->Update();
  EXPECT_TRUE(fs::is_empty(this->Folder.path("scratch")));
  EXPECT_EQ(12, this->total("Pieces"));
}

TEST_F(OutOfCoreFilter, RefusesToReplaceItsInput)
{
  const std::string input = this->Folder.path("points.npy");
  fs::create_hard_link(input, this->Folder.path("link.npy"));
  const std::string before = contentOf(input);
  this->Filter->SetFileName(this->Folder.path("link.npy").c_str());
  EXPECT_NE(std::string::npos, this->failure().find("is also an input"));
  EXPECT_EQ(before, contentOf(input));
}

TEST_F(OutOfCoreFilter, WarnsOfRejectedPointsAndOfNoTriangles)
{
  writePoints(this->Folder.path("points.npy"), { 0, 0, 1, 1, NAN, 2, 3, 3 });
  this->Filter->Update();
  EXPECT_EQ("", this->Errors);
  EXPECT_NE(std::string::npos, this->Warnings.find("1 of 4 points have a NaN"));
  EXPECT_NE(std::string::npos, this->Warnings.find("No triangles"));
}

TEST_F(OutOfCoreFilter, ReportsAMissingFile)
{
  this->Filter->AddInputFileName(this->Folder.path("nothing.npy").c_str());
  EXPECT_NE(std::string::npos, this->failure().find("nothing.npy: cannot be opened"));
}

TEST_F(OutOfCoreFilter, ReportsThatNoInputIsSet)
{
  this->Filter->ClearInputFileNames();
  EXPECT_NE(std::string::npos, this->failure().find("no files of points"));
}

TEST_F(OutOfCoreFilter, ReportsThatNoOutputIsSet)
{
  this->Filter->SetFileName(nullptr);
  EXPECT_NE(std::string::npos, this->failure().find("FileName is not set"));
}

TEST_F(OutOfCoreFilter, AcceptsALimitOfOneByte)
{
  this->Filter->SetMemoryLimit(-5);
  EXPECT_EQ(1, this->Filter->GetMemoryLimit());
  this->Filter->Update();
  EXPECT_TRUE(meshMatches(this->Folder.path("mesh.tipp"), this->Points, reference(this->Points)));
}

TEST(OutOfCoreTable, HasARowForEachPhase)
{
  OutOfCoreStatistics statistics;
  statistics.Phases = { { "survey", 1.5 }, { "spill", 2.5 } };
  statistics.TriangleSum = ~std::uint64_t(0);
  vtkNew<vtkTable> table;
  fillStatisticsTable(statisticsOf(statistics, true), table);
  ASSERT_EQ(2, table->GetNumberOfRows());
  EXPECT_EQ("spill", table->GetValueByName(1, "Phase").ToString());
  EXPECT_EQ(2.5, table->GetValueByName(1, "Seconds").ToDouble());
  EXPECT_EQ(0x1p64, table->GetFieldData()->GetArray("TriangleSum")->GetTuple1(0));
}

TEST_F(OutOfCoreFilter, InsertsConstraintsOfFiles)
{
  const auto file = [this](const char* name, const char* text)
  { return this->Folder.file(name, std::string("x1,y1,x2,y2\n") + text); };
  this->Filter->SetConstraintsFileName(
    file("lines.csv", "0.1,0.1,0.9,0.9\n0.1,0.9,0.9,0.1\n").c_str());
  this->Filter->SetBoundaryFileName(
    file("boundary.csv", "0.2,0.2,0.8,0.2\n0.8,0.2,0.8,0.8\n0.8,0.8,0.2,0.8\n0.2,0.8,0.2,0.2\n")
      .c_str());
  this->Filter->AddHole(0.5, 0.3);
  this->Filter->GenerateConstraintEdgesOn();
  this->Filter->Update();
  EXPECT_EQ("", this->Errors);
  EXPECT_EQ(6, this->total("Constraints"));
  EXPECT_EQ(1, this->total("CrossingPoints")); // both lines cross at the boundary's corners
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetFileName(this->Filter->GetFileName());
  reader->Update();
  auto* const mesh = vtkDataSet::SafeDownCast(reader->GetOutput());
  ASSERT_TRUE(mesh);
  double bounds[6];
  double area = 0;
  mesh->GetBounds(bounds);
  for (vtkIdType t = 0; t < mesh->GetNumberOfCells(); ++t)
  {
    double p[3][3];
    for (int i = 0; i < 3; ++i)
    {
      mesh->GetPoint(mesh->GetCell(t)->GetPointId(i), p[i]);
    }
    area +=
      ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1])) / 2;
  }
  EXPECT_NEAR(0.75 * 0.36, area, 1e-12); // one of the four parts is a hole
  vtkDataArray* const marks = mesh->GetCellData()->GetArray("ConstraintEdges");
  ASSERT_TRUE(marks);
  EXPECT_GT(marks->GetRange(-1)[1], 0);
}

TEST_F(OutOfCoreFilter, RefusesCrossingsAndHolesWithoutConstraints)
{
  this->Filter->AddHole(0.5, 0.3);
  EXPECT_NE(std::string::npos, this->failure().find("need a file of constraints"));
  this->Filter->SetConstraintsFileName(
    this->Folder.file("lines.csv", "x1,y1,x2,y2\n0.1,0.1,0.9,0.9\n0.1,0.9,0.9,0.1\n").c_str());
  this->Filter->ClearHoles();
  this->Filter->SplitCrossingsOff();
  EXPECT_NE(std::string::npos, this->failure().find("lines.csv: constraint 0"));
}

} // namespace
