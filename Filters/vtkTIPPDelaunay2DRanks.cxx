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

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

vtkExecutive* vtkTIPPDelaunay2D::CreateDefaultExecutive()
{
  if (DefaultExecutivePrototype)
  {
    return this->Superclass::CreateDefaultExecutive(); // the application's own, such as ParaView's
  }
  auto* executive = tipp::CollectivePipeline::New();
  executive->Controller = [this]() { return this->Controller; };
  return executive;
}

bool vtkTIPPDelaunay2D::HasSeveralRanks() const
{
  return this->Controller && this->Controller->GetNumberOfProcesses() > 1;
}

int vtkTIPPDelaunay2D::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->HasSeveralRanks())
  {
    return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  }
  // Whichever piece is requested, every rank contributes its share of the points and of the source.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    if (vtkInformation* input = inputVector[port]->GetInformationObject(0))
    {
      input->Set(Pipeline::UPDATE_PIECE_NUMBER(), this->Controller->GetLocalProcessId());
      input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), this->Controller->GetNumberOfProcesses());
      input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
  return 1;
}

tipp::DistributedOptions vtkTIPPDelaunay2D::OptionsForRanks() const
{
  const tipp::RankSchedule schedules[] = { tipp::RankSchedule::Stages, tipp::RankSchedule::Dynamic,
    tipp::RankSchedule::ProducerConsumer };
  const tipp::Masters masters[] = { tipp::Masters::Auto, tipp::Masters::Single,
    tipp::Masters::Multi };
  tipp::DistributedOptions options;
  options.Order = schedules[this->Schedule];
  options.Design = masters[this->Masters];
  options.Major = { this->NumberOfMajorPartitions[0], this->NumberOfMajorPartitions[1] };
  options.Minor = { this->NumberOfPartitions[0], this->NumberOfPartitions[1] };
  options.MinorDivision = options.Minor.isGiven() ? tipp::Division::Grid
    : this->MinorDivision == THRESHOLD            ? tipp::Division::Threshold
                                                  : tipp::Division::Tree;
  options.Threshold = this->PointsPerPartition;
  options.Groups = this->EqualGroups ? tipp::GroupSizes::Equal : tipp::GroupSizes::Proportional;
  options.InitialPointsPerPartition = this->InitialPointsPerPartition;
  options.Threads = this->NumberOfThreads;
  return options;
}

const char* vtkTIPPDelaunay2D::WhatNeedsOneRank()
{
  return this->Alpha != 0                                 ? "Alpha"
    : this->MaximumEdgeLength > 0                         ? "MaximumEdgeLength"
    : this->Tolerance > 0                                 ? "Tolerance"
    : this->BoundingTriangulation                         ? "BoundingTriangulation"
    : this->GenerateNeighborIds                           ? "GenerateNeighborIds"
    : this->ProjectionPlaneMode == VTK_BEST_FITTING_PLANE ? "the best fitting plane"
                                                          : nullptr;
}

/// Combines the sources of all ranks. Returns null if no rank has a source.
std::unique_ptr<tipp::RankSource> vtkTIPPDelaunay2D::ShareSource(
  tipp::Communicator& ranks, vtkPointSet* input, vtkPolyData* source, bool wantsCells)
{
  std::vector<std::int64_t> sources{ source ? 1 : 0 };
  ranks.sum(sources);
  if (sources[0] == 0)
  {
    return nullptr;
  }
  tipp::RankSourceOptions options;
  options.MergesPoints = this->MergeSourcePoints != 0;
  options.Crossings = this->SplitCrossings ? tipp::CrossingRule::Split : tipp::CrossingRule::Refuse;
  options.WantsCells = wantsCells;
  options.ToPlane = this->Transform;
  options.Threads = this->NumberOfThreads;
  return std::make_unique<tipp::RankSource>(tipp::shareSource(ranks, input, source, options));
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
    if (const char* what = this->WhatNeedsOneRank())
    {
      throw std::invalid_argument(
        std::string(what) + " needs a single rank: set the controller to null on one rank.");
    }
    if (this->ProjectionPlaneMode == VTK_SET_TRANSFORM_PLANE && !this->Transform)
    {
      throw std::invalid_argument("ProjectionPlaneMode is VTK_SET_TRANSFORM_PLANE, but there is no "
                                  "Transform: call SetTransform, or choose another mode.");
    }
    tipp::Monitor monitor(this);
    tipp::DistributedOptions options = this->OptionsForRanks();
    options.Progress = [&monitor](double fraction) { return monitor(fraction); };
    tipp::checkPoints(given, "the input");
    // Collective steps must be done by all ranks or by none, even if their properties differ.
    std::vector<std::int64_t> wishes{ ranks.rank() == 0 && this->GatherOnFirstRank, wantsGhosts,
      this->ConstraintMarks == LINES };
    ranks.sum(wishes);
    shared = this->ShareSource(ranks, given, source, wishes[2] > 0);
    vtkPointSet* const input = shared ? shared->Input.Get() : given;
    const tipp::PointRows rows(ranks, input);
    const tipp::ProjectedPoints projected(input->GetPoints(), this->Transform);
    tipp::RankPoints points;
    points.Points = shared && !shared->Positions.empty()
      ? tipp::PointsView(&shared->Positions.front().x, shared->Positions.size(), 2)
      : projected.view();
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
      tipp::addAccounts(mine.Duplicates, mine.Rejected, output);
    }
    tipp::RunStatistics all = tipp::statisticsOf(mine);
    shared ? tipp::addConstraintTotals(shared->Figures, all) : void();
    tipp::fillStatisticsTable(all, statistics);
  };
  try
  {
    ranks.together(run);
  }
  catch (const tipp::RankFailure& failure)
  {
    output->Initialize();
    statistics->Initialize();
    if (failure.Aborted)
    {
      return true;
    }
    this->SetErrorCode(vtkErrorCode::UserError);
    if (ranks.rank() == 0)
    {
      vtkErrorMacro("Rank " << failure.Rank << ": " << failure.what());
    }
    return false;
  }
  this->NumberOfDuplicatePoints = mine.AllDuplicates;
  this->NumberOfRejectedPoints = mine.AllRejected;
  for (const std::string& warning :
    ranks.isFirst() ? tipp::warningsOf(mine) : std::vector<std::string>())
  {
    vtkWarningMacro(<< warning);
  }
  if (ranks.isFirst() && shared && shared->Figures.NotFinite > 0)
  {
    vtkWarningMacro(
      << shared->Figures.NotFinite
      << " edges of the source have an end that is NaN or infinite and are left out.");
  }
  return true;
}
