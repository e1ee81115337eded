// SPDX-License-Identifier: BSD-3-Clause
// Draws the cases of fuzzConstraints, and triangulates them on several ranks: in the memory of the
// ranks, and out of core. Compares the results with that of one process in memory.
#include "ConstraintCases.h"
#include "Constraints/ResolveCrossings.h"
#include "FuzzDriver.h"
#include "TemporaryFolder.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Ranks/Communicator.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkMPIController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTIPPDelaunay2D.h"

#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}

/// Whether this holds on all ranks.
bool holdsOnAll(bool holds)
{
  const int mine = holds ? 1 : 0;
  int all = 0;
  controller()->AllReduce(&mine, &all, 1, vtkCommunicator::MIN_OP);
  return all != 0;
}

testing::AssertionResult isSameOnDisk(const ConstraintCase& drawn, const MadeInMemory& made)
{
  if (made.Points.size() == made.Result.Mesh.Rejected.size() && made.Refused.empty())
  {
    return testing::AssertionSuccess(); // out of core, no finite point is an error
  }
  Communicator ranks(controller());
  const bool isFirst = ranks.rank() == 0;
  const std::unique_ptr<TemporaryFolder> folder =
    isFirst ? std::make_unique<TemporaryFolder>() : nullptr;
  const std::string path = isFirst ? folder->path("mesh.tipp") : "";
  try
  {
    triangulateOutOfCoreOnRanks(
      ranks,
      [&]
      {
        return std::make_unique<ConstrainedStream>(
          drawn.stream(), drawn.Constraints, "constraints", 1);
      },
      path, drawn.OnDisk);
  }
  catch (const RankFailure& error)
  {
    return made.Refused.empty() || std::string(error.what()).find(made.Refused) == std::string::npos
      ? testing::AssertionFailure() << "out of core: " << error.what()
      : testing::AssertionSuccess();
  }
  if (!made.Refused.empty())
  {
    return testing::AssertionFailure() << "out of core the crossing is not refused";
  }
  const auto outcome = isFirst ? isSameMesh(path, made) : testing::AssertionSuccess();
  return outcome ? outcome : testing::AssertionFailure() << "out of core: " << outcome.message();
}

/// Points with the array 'height', and global ids if `firstId` is not negative.
class PointSetMaker
{
public:
  PointSetMaker()
  {
    this->Points->SetDataTypeToDouble();
    this->Heights->SetName("height");
    this->Ids->SetName("ids");
  }

  void add(const double* xy, double height, std::int64_t id)
  {
    this->Points->InsertNextPoint(xy[0], xy[1], 0);
    this->Heights->InsertNextValue(height);
    this->Ids->InsertNextValue(id);
  }

  vtkSmartPointer<vtkPolyData> take(bool hasIds) const
  {
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(this->Points);
    data->GetPointData()->AddArray(this->Heights);
    if (hasIds)
    {
      data->GetPointData()->SetGlobalIds(this->Ids);
    }
    return data;
  }

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Heights;
  vtkNew<vtkIdTypeArray> Ids;
};

/// Every rank has the points whose ids it gets in turn.
vtkSmartPointer<vtkPolyData> shareOf(const ConstraintCase& drawn)
{
  PointSetMaker maker;
  for (std::size_t i = 0; i < drawn.points(); ++i)
  {
    if (int(i) % controller()->GetNumberOfProcesses() == controller()->GetLocalProcessId())
    {
      maker.add(&drawn.XY[2 * i], drawn.Heights[i], std::int64_t(i));
    }
  }
  return maker.take(true);
}

vtkSmartPointer<vtkPolyData> sourceOf(const ConstraintCase& drawn)
{
  const ConstraintTable& lines = drawn.Constraints.Lines;
  PointSetMaker maker;
  for (std::size_t i = 0; i < lines.Height.size(); ++i)
  {
    maker.add(&lines.XY[2 * i], lines.Height[i], 0);
  }
  const auto source = maker.take(false);
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < lines.PolygonBegin; ++i)
  {
    const vtkIdType ends[2] = { vtkIdType(lines.Edges[i][0]), vtkIdType(lines.Edges[i][1]) };
    cells->InsertNextCell(2, ends);
  }
  source->SetLines(cells);
  vtkNew<vtkCellArray> polygons;
  std::size_t begin = lines.PolygonBegin;
  for (const std::size_t end : drawn.PolygonEnds)
  {
    std::vector<vtkIdType> corners;
    for (; begin < end; ++begin)
    {
      corners.push_back(vtkIdType(lines.Edges[begin][0]));
    }
    polygons->InsertNextCell(vtkIdType(corners.size()), corners.data());
  }
  source->SetPolys(polygons);
  return source;
}

testing::AssertionResult isSameOutput(vtkPolyData* mesh, const MadeInMemory& made)
{
  auto* const ids = vtkIdTypeArray::SafeDownCast(mesh->GetPointData()->GetGlobalIds());
  auto* const heights = mesh->GetPointData()->GetArray("height");
  Triangles triangles;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfPolys(); ++cell)
  {
    mesh->GetPolys()->GetCellAtId(cell, corners);
    for (const vtkIdType corner : { corners->GetId(0), corners->GetId(1), corners->GetId(2) })
    {
      const auto id = std::size_t(ids->GetValue(corner));
      const double* const p = mesh->GetPoint(corner);
      if (id >= made.Points.size() || p[0] != made.Points.XY[2 * id] ||
        p[1] != made.Points.XY[2 * id + 1])
      {
        return testing::AssertionFailure() << "point " << id << " is elsewhere";
      }
      if (heights->GetTuple1(corner) != made.Points.Columns.front().Values[id])
      {
        return testing::AssertionFailure()
          << "point " << id << " has the height " << heights->GetTuple1(corner);
      }
    }
    triangles.push_back(canonical(ids->GetValue(corners->GetId(0)),
      ids->GetValue(corners->GetId(1)), ids->GetValue(corners->GetId(2))));
  }
  return sameTriangles(made.Points.XY, sorted(std::move(triangles)), trianglesOf(made.Result.Mesh));
}

testing::AssertionResult isSameInMemory(const ConstraintCase& drawn, const MadeInMemory& made)
{
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetMergeSourcePoints(!drawn.Constraints.Lines.XY.empty());
  filter->SetSplitCrossings(drawn.Constraints.Crossings == CrossingRule::Split);
  filter->SetPointsPerPartition(int(drawn.OnDisk.PartitionPoints));
  filter->SetNumberOfThreads(1);
  filter->SetGatherOnFirstRank(true);
  filter->SetInputData(shareOf(drawn));
  filter->SetSourceData(sourceOf(drawn));
  filter->Update();
  if ((filter->GetErrorCode() != 0) == made.Refused.empty())
  {
    return testing::AssertionFailure() << "on ranks the error is " << filter->GetErrorCode();
  }
  if (!made.Refused.empty() || controller()->GetLocalProcessId() != 0)
  {
    return testing::AssertionSuccess();
  }
  const auto outcome = isSameOutput(filter->GetOutput(), made);
  return outcome ? outcome : testing::AssertionFailure() << "on ranks: " << outcome.message();
}

testing::AssertionResult check(const ConstraintCase& drawn)
{
  try
  {
    const MadeInMemory made = makeInMemory(drawn);
    const auto outcome = isSameOnDisk(drawn, made);
    const auto other = isSameInMemory(drawn, made);
    return outcome ? other : outcome;
  }
  catch (const std::exception& error)
  {
    return testing::AssertionFailure() << "an exception: " << error.what();
  }
}

/// Runs one case on all ranks, and prints it if it fails on any of them.
bool passes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq both{ seed, number };
  Engine random(both);
  const ConstraintCase drawn = drawConstraintCase(random);
  const auto outcome = check(drawn);
  if (!outcome)
  {
    std::fprintf(stderr, "case %llu of seed %llu, rank %d: %s\n", (unsigned long long)number,
      (unsigned long long)seed, controller()->GetLocalProcessId(), outcome.message());
  }
  const bool isRight = holdsOnAll(bool(outcome));
  if (!isRight && controller()->GetLocalProcessId() == 0)
  {
    drawn.print();
  }
  return isRight;
}

} // namespace

int main(int argc, char** argv)
{
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int failed = 1;
  {
    vtkNew<vtkMPIController> mpi;
    mpi->Initialize(&argc, &argv, 1);
    vtkMultiProcessController::SetGlobalController(mpi);
    vtkObject::GlobalWarningDisplayOff(); // about points that are not finite, and refused crossings
    if (mpi->GetLocalProcessId() != 0)
    {
      std::fclose(stdout);
    }
    failed = fuzz("fuzzConstraintsOnRanks", argc, argv, passes, holdsOnAll);
    vtkMultiProcessController::SetGlobalController(nullptr);
    mpi->Finalize(1);
  }
  MPI_Finalize();
  return failed;
}
