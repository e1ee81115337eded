// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay2D on several ranks.
#include "vtkTIPPDelaunay2D.h"

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
    return this->Superclass::CreateDefaultExecutive(); // an application's own, e.g. ParaView's
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
  // Whatever piece is asked for, every rank brings its share of the points.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  input->Set(Pipeline::UPDATE_PIECE_NUMBER(), this->Controller->GetLocalProcessId());
  input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), this->Controller->GetNumberOfProcesses());
  input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
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
    : this->GetNumberOfInputConnections(1) > 0            ? "a source with constraints"
    : this->ProjectionPlaneMode == VTK_BEST_FITTING_PLANE ? "the best fitting plane"
                                                          : nullptr;
}

bool vtkTIPPDelaunay2D::ExecuteOnRanks(
  vtkPointSet* input, bool wantsGhosts, vtkPolyData* output, vtkTable* statistics)
{
  this->NumberOfDuplicatePoints = 0;
  this->NumberOfRejectedPoints = 0;
  tipp::Communicator ranks(this->Controller);
  tipp::DistributedTriangulation mine;
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
    tipp::checkPoints(input, "the input");
    const tipp::PointRows rows(ranks, input);
    const tipp::ProjectedPoints projected(input->GetPoints(), this->Transform);
    tipp::RankPoints points;
    points.Points = projected.view();
    rows.describe(points);
    mine = tipp::triangulateDistributed(ranks, points, options);
    // What is collective is done by all ranks or by none, whatever single ones are set to.
    std::vector<std::int64_t> wishes{ ranks.rank() == 0 && this->GatherOnFirstRank, wantsGhosts };
    ranks.sum(wishes);
    if (wishes[0] > 0)
    {
      mine = tipp::gatherOnFirst(ranks, std::move(mine));
    }
    std::unique_ptr<tipp::GhostTriangles> ghosts;
    if (wishes[1] > 0)
    {
      ghosts = std::make_unique<tipp::GhostTriangles>(tipp::fetchGhosts(ranks, mine));
    }
    tipp::fillPiece(mine, ranks.rank(), rows, wantsGhosts ? ghosts.get() : nullptr, output);
    if (this->GenerateRepresentativeIds)
    {
      tipp::addAccounts(mine, output);
    }
    tipp::fillStatisticsTable(tipp::statisticsOf(mine), statistics);
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
  return true;
}
