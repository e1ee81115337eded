// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay3D on several ranks.
#include "vtkTIPPDelaunay3D.h"

#include "Distributed3D/DistributedTetrahedralization.h"
#include "Output/FilterPipeline.h"
#include "Output/RunStatistics.h"
#include "Output/TetrahedronOutput.h"
#include "Vtk/ReadDataSet.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

vtkExecutive* vtkTIPPDelaunay3D::CreateDefaultExecutive()
{
  if (DefaultExecutivePrototype)
  {
    return this->Superclass::CreateDefaultExecutive(); // an application's own, e.g. ParaView's
  }
  auto* executive = tipp::CollectivePipeline::New();
  executive->Controller = [this]() { return this->Controller; };
  return executive;
}

bool vtkTIPPDelaunay3D::HasSeveralRanks() const
{
  return this->Controller && this->Controller->GetNumberOfProcesses() > 1;
}

int vtkTIPPDelaunay3D::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->HasSeveralRanks())
  {
    return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  }
  // Whatever piece is asked for, every rank brings its share of the points.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const input = inputVector[0]->GetInformationObject(0);
  input->Set(Pipeline::UPDATE_PIECE_NUMBER(), this->Controller->GetLocalProcessId());
  input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), this->Controller->GetNumberOfProcesses());
  input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  return 1;
}

const char* vtkTIPPDelaunay3D::WhatNeedsOneRank()
{
  return this->Alpha != 0         ? "Alpha"
    : this->Tolerance > 0         ? "Tolerance"
    : this->BoundingTriangulation ? "BoundingTriangulation"
    : this->GenerateNeighborIds   ? "GenerateNeighborIds"
                                  : nullptr;
}

bool vtkTIPPDelaunay3D::ExecuteOnRanks(
  vtkPointSet* input, bool wantsGhosts, vtkUnstructuredGrid* output, vtkTable* statistics)
{
  this->NumberOfDuplicatePoints = 0;
  this->NumberOfRejectedPoints = 0;
  tipp::Communicator ranks(this->Controller);
  tipp::DistributedTetrahedralization mine;
  const auto run = [&]()
  {
    if (const char* what = this->WhatNeedsOneRank())
    {
      throw std::invalid_argument(
        std::string(what) + " needs a single rank: set the controller to null on one rank.");
    }
    tipp::Monitor monitor(this);
    tipp::TetrahedralizationOptions options;
    options.Partitions = this->NumberOfPartitions;
    options.Threads = this->NumberOfThreads;
    options.Progress = [&monitor](double fraction) { return monitor(fraction); };
    tipp::checkPoints(input, "the input");
    // What is collective is done by all ranks or by none, whatever single ones are set to.
    std::vector<std::int64_t> wishes{ ranks.isFirst() && this->GatherOnFirstRank, wantsGhosts };
    ranks.sum(wishes);
    const tipp::PointRows rows(ranks, input);
    tipp::RankPoints3 points;
    std::vector<tipp::Point3> copy;
    points.Count = std::size_t(input->GetNumberOfPoints());
    points.Points = points.Count > 0 ? tipp::coordinatesOf(input->GetPoints(), copy) : nullptr;
    rows.describe(points);
    mine = tipp::tetrahedralizeDistributed(ranks, points, options);
    if (wishes[0] > 0)
    {
      mine = tipp::gatherOnFirst(ranks, std::move(mine), options.Threads);
    }
    std::unique_ptr<tipp::GhostTetrahedra> ghosts;
    if (wishes[1] > 0)
    {
      ghosts = std::make_unique<tipp::GhostTetrahedra>(tipp::fetchGhosts(ranks, mine));
    }
    tipp::fillPiece(mine, ranks.rank(), rows, wantsGhosts ? ghosts.get() : nullptr, output);
    if (this->GenerateRepresentativeIds)
    {
      tipp::addAccounts(mine.Duplicates, mine.Rejected, output);
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
    if (ranks.isFirst())
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
