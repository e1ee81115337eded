// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay2D on several ranks.
#include "vtkTIPPDelaunay2D.h"

#include "Constraints/RankSource.h"
#include "Distributed/DistributedTriangulation.h"
#include "Distributed/TriangleExchange.h"
#include "Output/FilterPipeline.h"
#include "Output/RunStatistics.h"
#include "Output/TriangleOutput.h"
#include "Projection/ProjectedPoints.h"
#include "Vtk/ReadDataSet.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

tipp::DistributedOptions optionsFor(vtkTIPPDelaunay2D* filter)
{
  const tipp::RankSchedule schedules[] = { tipp::RankSchedule::Stages, tipp::RankSchedule::Dynamic,
    tipp::RankSchedule::ProducerConsumer };
  const tipp::Masters masters[] = { tipp::Masters::Auto, tipp::Masters::Single,
    tipp::Masters::Multi };
  tipp::DistributedOptions options;
  options.Order = schedules[filter->GetSchedule()];
  options.Design = masters[filter->GetMasters()];
  options.Major = { filter->GetNumberOfMajorPartitions()[0],
    filter->GetNumberOfMajorPartitions()[1] };
  options.Minor = { filter->GetNumberOfPartitions()[0], filter->GetNumberOfPartitions()[1] };
  options.MinorDivision = options.Minor.isGiven()                ? tipp::Division::Grid
    : filter->GetMinorDivision() == vtkTIPPDelaunay2D::THRESHOLD ? tipp::Division::Threshold
                                                                 : tipp::Division::Tree;
  options.Threshold = filter->GetPointsPerPartition();
  options.Groups =
    filter->GetEqualGroups() ? tipp::GroupSizes::Equal : tipp::GroupSizes::Proportional;
  options.InitialPointsPerPartition = filter->GetInitialPointsPerPartition();
  options.Threads = filter->GetNumberOfThreads();
  return options;
}

/// Combines the sources of all ranks. Returns null if no rank has a source.
std::unique_ptr<tipp::RankSource> shareSource(vtkTIPPDelaunay2D* filter, tipp::Communicator& ranks,
  vtkPointSet* input, vtkPolyData* source, bool wantsCells)
{
  std::vector<std::int64_t> sources{ source ? 1 : 0 };
  ranks.sum(sources);
  if (sources[0] == 0)
  {
    return nullptr;
  }
  tipp::RankSourceOptions options;
  options.MergesPoints = filter->GetMergeSourcePoints() != 0;
  options.Crossings =
    filter->GetSplitCrossings() ? tipp::CrossingRule::Split : tipp::CrossingRule::Refuse;
  options.WantsCells = wantsCells;
  options.ToPlane = filter->GetTransform();
  options.Threads = filter->GetNumberOfThreads();
  return std::make_unique<tipp::RankSource>(tipp::shareSource(ranks, input, source, options));
}

} // namespace

int vtkTIPPDelaunay2D::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!tipp::hasSeveralRanks(this->Controller))
  {
    return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  }
  // Whichever piece is requested, every rank contributes its share of the points and of the source.
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    if (vtkInformation* input = inputVector[port]->GetInformationObject(0))
    {
      tipp::askForRankPiece(input, this->Controller);
    }
  }
  return 1;
}

bool vtkTIPPDelaunay2D::ExecuteOnRanks(vtkPointSet* given, vtkPolyData* source, bool wantsGhosts,
  vtkPolyData* output, vtkTable* statistics)
{
  this->NumberOfDuplicatePoints = 0;
  this->NumberOfRejectedPoints = 0;
  tipp::Communicator ranks(this->Controller);
  tipp::DistributedTriangulation mine;
  std::unique_ptr<tipp::RankSource> shared;
  const auto run = [&]()
  {
    tipp::requireUnused({ { "Alpha", this->Alpha != 0 },
      { "MaximumEdgeLength", this->MaximumEdgeLength > 0 }, { "Tolerance", this->Tolerance > 0 },
      { "BoundingTriangulation", this->BoundingTriangulation != 0 },
      { "GenerateNeighborIds", this->GenerateNeighborIds != 0 },
      { "the best fitting plane", this->ProjectionPlaneMode == VTK_BEST_FITTING_PLANE } });
    if (this->ProjectionPlaneMode == VTK_SET_TRANSFORM_PLANE && !this->Transform)
    {
      throw std::invalid_argument("ProjectionPlaneMode is VTK_SET_TRANSFORM_PLANE, but there is no "
                                  "Transform: call SetTransform, or choose another mode.");
    }
    tipp::Monitor monitor(this);
    tipp::DistributedOptions options = optionsFor(this);
    options.Progress = [&monitor](double fraction) { return monitor(fraction); };
    tipp::checkPoints(given, "the input");
    // Collective steps must be done by all ranks or by none, even if their properties differ.
    std::vector<std::int64_t> wishes{ ranks.rank() == 0 && this->GatherOnFirstRank, wantsGhosts,
      this->ConstraintMarks == LINES };
    ranks.sum(wishes);
    shared = shareSource(this, ranks, given, source, wishes[2] > 0);
    vtkPointSet* const input = shared ? shared->Input.Get() : given;
    const tipp::PointRows rows(ranks, input);
    const tipp::ProjectedPoints projected(input->GetPoints(), this->Transform);
    tipp::RankPoints points;
    points.Points =
      shared && !shared->Positions.empty() ? tipp::PointsView(shared->Positions) : projected.view();
    rows.describe(points);
    mine = tipp::triangulateDistributed(ranks, points, options);
    if (shared)
    {
      tipp::constrainRanks(ranks, *shared->Segments, options.Threads, mine);
    }
    if (wishes[0] > 0)
    {
      mine = tipp::gatherOnFirst(ranks, std::move(mine));
    }
    std::unique_ptr<tipp::GhostTriangles> ghosts;
    if (wishes[1] > 0)
    {
      ghosts = std::make_unique<tipp::GhostTriangles>(tipp::fetchGhosts(ranks, mine));
    }
    tipp::ConstraintLines lines;
    if (shared && wishes[2] > 0)
    {
      lines =
        tipp::findConstraintLines(ranks, { *shared->Segments, shared->Order, shared->Cells }, mine);
    }
    tipp::PieceMarks marks;
    marks.Flags = shared && this->ConstraintMarks == EDGE_FLAGS ? shared->Segments.get() : nullptr;
    marks.Lines = shared && this->ConstraintMarks == LINES ? &lines : nullptr;
    tipp::fillPiece(mine, ranks.rank(), rows, wantsGhosts ? ghosts.get() : nullptr, marks, output);
    if (this->GenerateRepresentativeIds)
    {
      tipp::addDuplicatesAndRejected(mine.Duplicates, mine.Rejected, output);
    }
    tipp::RunStatistics all = tipp::statisticsOf(mine);
    shared ? tipp::addConstraintTotals(shared->Figures, all) : void();
    tipp::fillStatisticsTable(all, statistics);
  };
  ranks.together(run);
  this->NumberOfDuplicatePoints = mine.AllDuplicates;
  this->NumberOfRejectedPoints = mine.AllRejected;
  if (ranks.isFirst())
  {
    tipp::warn(this, tipp::warningsOf(mine));
  }
  if (ranks.isFirst() && shared && shared->Figures.NotFinite > 0)
  {
    vtkWarningMacro(
      << shared->Figures.NotFinite
      << " edges of the source have an end that is NaN or infinite and are left out.");
  }
  return true;
}
