// SPDX-License-Identifier: BSD-3-Clause
// How vtkTIPPDelaunay2D runs in a pipeline: when it executes, its progress, abort, errors and
// statistics.
#include "Delaunay2DTesting.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTransform.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <new>
#include <sstream>
#include <stdexcept>
#include <thread>

using namespace testing_delaunay;

namespace
{

class RunCounter
{
public:
  explicit RunCounter(vtkAlgorithm* algorithm)
  {
    algorithm->AddObserver(vtkCommand::StartEvent, this, &RunCounter::hear);
  }
  int Runs = 0;

private:
  void hear() { ++this->Runs; }
};

/// Records progress, and aborts the algorithm once progress reaches `stopAt`.
class ProgressListener
{
public:
  explicit ProgressListener(vtkAlgorithm* algorithm, double stopAt = 2)
    : StopAt(stopAt)
  {
    algorithm->AddObserver(vtkCommand::ProgressEvent, this, &ProgressListener::hear);
  }
  std::vector<double> Heard;
  bool OtherThread = false;

private:
  void hear(vtkObject* caller, unsigned long, void* progress)
  {
    this->Heard.push_back(*static_cast<double*>(progress));
    this->OtherThread = this->OtherThread || std::this_thread::get_id() != this->Owner;
    if (this->Heard.back() >= this->StopAt)
    {
      static_cast<vtkAlgorithm*>(caller)->AbortExecuteOn();
    }
  }
  double StopAt;
  std::thread::id Owner = std::this_thread::get_id();
};

/// A transform that throws, for example because memory is exhausted.
template <typename Exception>
class FailingTransform : public vtkTransform
{
public:
  static FailingTransform* New() { VTK_STANDARD_NEW_BODY(FailingTransform); }
  void TransformPoints(vtkPoints*, vtkPoints*) override { throw Exception(); }
};

struct Shortage : std::runtime_error
{
  Shortage()
    : std::runtime_error("the sky fell")
  {
  }
};

template <typename Exception>
std::string errorOf()
{
  vtkNew<FailingTransform<Exception>> transform;
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(10)));
  delaunay->SetTransform(transform);
  Messages messages(delaunay);
  Messages executive(delaunay->GetExecutive());
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfPoints());
  return messages.Errors.size() == 1 ? messages.Errors[0] : "";
}

double total(vtkTable* statistics, const char* name)
{
  vtkDataArray* array = statistics->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfTuples() == 1 ? array->GetTuple1(0) : -1;
}

} // namespace

TEST(Delaunay2DRun, RunsAgainOnlyAfterAChange)
{
  const auto input = dataset(randomPoints(50));
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  RunCounter counter(delaunay);
  delaunay->SetInputData(input);
  delaunay->Update();
  delaunay->SetAlpha(delaunay->GetAlpha());
  delaunay->Update();
  EXPECT_EQ(1, counter.Runs);
  delaunay->SetNumberOfThreads(2);
  delaunay->Update();
  EXPECT_EQ(2, counter.Runs);
  input->Modified();
  delaunay->Update();
  EXPECT_EQ(3, counter.Runs);
}

TEST(Delaunay2DRun, FollowsItsInputInAPipeline)
{
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(dataset(randomPoints(50, 1)));
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputConnection(producer->GetOutputPort());
  const Cells before = trianglesOf(delaunay);
  producer->SetOutput(dataset(randomPoints(60, 2)));
  EXPECT_NE(before, trianglesOf(delaunay));
  EXPECT_EQ(60, delaunay->GetOutput()->GetNumberOfPoints());
}

TEST(Delaunay2DRun, ProgressGrowsToOneInTheCallersThread)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(50000)));
  delaunay->SetNumberOfPartitions(8, 8);
  delaunay->SetNumberOfThreads(3);
  ProgressListener progress(delaunay);
  delaunay->Update();
  EXPECT_TRUE(std::any_of(progress.Heard.begin(), progress.Heard.end(),
    [](double fraction) { return fraction > 0.1 && fraction < 0.9; }));
  EXPECT_TRUE(std::is_sorted(progress.Heard.begin(), progress.Heard.end()));
  EXPECT_EQ(1, progress.Heard.back());
  EXPECT_FALSE(progress.OtherThread);
}

TEST(Delaunay2DRun, AbortInMidRunLeavesBothOutputsEmpty)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(50000)));
  delaunay->SetNumberOfPartitions(8, 8);
  ProgressListener progress(delaunay, 0.2);
  delaunay->Update();
  // The abort is heard at once. VTK 9.3 and later report progress 1 even after an aborted run.
  EXPECT_EQ(1,
    std::count_if(progress.Heard.begin(), progress.Heard.end(),
      [](double fraction) { return fraction >= 0.2 && fraction < 1; }));
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfCells());
  EXPECT_EQ(0, delaunay->GetStatistics()->GetNumberOfColumns());
}

TEST(Delaunay2DRun, AbortWhileMergingLeavesTheOutputEmpty)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(500)));
  delaunay->SetTolerance(1e-7);
  ProgressListener progress(delaunay, 0);
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfPoints());
}

TEST(Delaunay2DRun, RunAfterAnAbortIsComplete)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(1000)));
  const Cells expected = trianglesOf(delaunay);
  delaunay->Modified();
  {
    ProgressListener progress(delaunay, 0);
    delaunay->Update();
    delaunay->RemoveAllObservers();
  }
  ASSERT_EQ(0, delaunay->GetOutput()->GetNumberOfCells());
  delaunay->SetAbortExecute(0); // VTK 9.3 and later do not reset it
  delaunay->Modified();
  EXPECT_EQ(expected, trianglesOf(delaunay));
}

TEST(Delaunay2DRun, DoesNotChangeTheCallersNumberOfThreads)
{
  const int before = omp_get_max_threads();
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(1000)));
  delaunay->SetNumberOfThreads(before + 3);
  delaunay->Update();
  EXPECT_EQ(before, omp_get_max_threads());
}

TEST(Delaunay2DRun, LackOfMemoryIsAnError)
{
  EXPECT_NE(std::string::npos, errorOf<std::bad_alloc>().find("not enough memory"));
}

TEST(Delaunay2DRun, ExceptionsAreErrors)
{
  EXPECT_NE(std::string::npos, errorOf<Shortage>().find("the sky fell"));
}

TEST(Delaunay2DRun, RefusesPointArraysOfTooFewValues)
{
  const auto points = dataset(randomPoints(10));
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("heat");
  heat->SetNumberOfTuples(9);
  points->GetPointData()->AddArray(heat);
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(points);
  Messages messages(delaunay);
  Messages executive(delaunay->GetExecutive());
  delaunay->Update();
  ASSERT_EQ(1U, messages.Errors.size());
  EXPECT_NE(std::string::npos, messages.Errors[0].find("'heat' has 9 values for 10 points"))
    << messages.Errors[0];
}

TEST(Delaunay2DRun, PartitionsScheduleAndThreadsDoNotChangeTheTriangles)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(3000)));
  const Cells expected = trianglesOf(delaunay);
  for (int threads : { 1, 3 })
  {
    delaunay->SetNumberOfThreads(threads);
    delaunay->SetScheduleToStages();
    delaunay->SetNumberOfPartitions(5, 3);
    EXPECT_EQ(expected, trianglesOf(delaunay));
    delaunay->SetInitialPointsPerPartition(4);
    EXPECT_EQ(expected, trianglesOf(delaunay));
    delaunay->SetScheduleToDynamic();
    EXPECT_EQ(expected, trianglesOf(delaunay));
    delaunay->SetNumberOfPartitions(-2, 7);
    EXPECT_EQ(expected, trianglesOf(delaunay));
  }
}

TEST(Delaunay2DRun, StatisticsHaveTheTotals)
{
  auto points = randomPoints(500);
  points.push_back(points.front());
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(points));
  const std::size_t triangles = trianglesOf(delaunay).size();
  vtkTable* statistics = delaunay->GetStatistics();
  EXPECT_EQ(501, total(statistics, "Points"));
  EXPECT_EQ(double(triangles), total(statistics, "Triangles"));
  EXPECT_EQ(1, total(statistics, "DuplicatePoints"));
  EXPECT_EQ(0, total(statistics, "RejectedPoints"));
  EXPECT_GE(total(statistics, "Partitions"), 1);
  EXPECT_GE(total(statistics, "Threads"), 1);
}

TEST(Delaunay2DRun, StatisticsHaveThePhasesAndTheirSeconds)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(500)));
  delaunay->Update();
  vtkFieldData* fields = delaunay->GetStatistics()->GetFieldData();
  auto names = vtkStringArray::SafeDownCast(fields->GetAbstractArray("PhaseName"));
  vtkDataArray* seconds = fields->GetArray("PhaseSeconds");
  ASSERT_TRUE(names && seconds);
  ASSERT_EQ(names->GetNumberOfValues(), seconds->GetNumberOfTuples());
  ASSERT_GE(names->GetNumberOfValues(), 2);
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    EXPECT_FALSE(names->GetValue(i).empty());
    EXPECT_GE(seconds->GetTuple1(i), 0);
  }
}

TEST(Delaunay2DRun, StatisticsHaveARowForEachStage)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(500)));
  delaunay->Update();
  vtkTable* statistics = delaunay->GetStatistics();
  ASSERT_EQ(3, statistics->GetNumberOfColumns());
  for (const char* name : { "Stage", "ActivePartitions", "MeshTriangles" })
  {
    EXPECT_NE(nullptr, statistics->GetColumnByName(name)) << name;
  }
  for (vtkIdType row = 0; row < statistics->GetNumberOfRows(); ++row)
  {
    EXPECT_EQ(row, statistics->GetValue(row, 0).ToInt());
    EXPECT_GE(statistics->GetValue(row, 1).ToInt(), 1);
  }
}

TEST(Delaunay2DRun, PropertiesHaveTheDefaultsOfVtkDelaunay2D)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  EXPECT_EQ(0, delaunay->GetAlpha());
  EXPECT_EQ(1, delaunay->GetOffset());
  EXPECT_EQ(0, delaunay->GetBoundingTriangulation());
  EXPECT_EQ(VTK_DELAUNAY_XY_PLANE, delaunay->GetProjectionPlaneMode());
  EXPECT_EQ(nullptr, delaunay->GetTransform());
  EXPECT_EQ(0, delaunay->GetTolerance());
}

TEST(Delaunay2DRun, PrintShowsEveryProperty)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetNumberOfPartitions(6, 5);
  std::ostringstream text;
  delaunay->Print(text);
  EXPECT_NE(std::string::npos, text.str().find("NumberOfPartitions: 6 x 5"));
  for (const char* name : { "Alpha:", "AlphaTris:", "AlphaLines:", "AlphaVerts:", "Tolerance:",
         "Offset:", "BoundingTriangulation:", "ProjectionPlaneMode:", "Transform:",
         "GenerateRepresentativeIds:", "GenerateNeighborIds:", "InitialPointsPerPartition:",
         "Schedule:", "NumberOfThreads:", "NumberOfDuplicatePoints:", "NumberOfRejectedPoints:" })
  {
    EXPECT_NE(std::string::npos, text.str().find(name)) << name;
  }
}
