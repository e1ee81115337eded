// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay3D on several ranks.
#include "vtkTIPPDelaunay3D.h"

#include "Distributed3D/DistributedTetrahedralization.h"
#include "Output/FilterPipeline.h"
#include "Output/RunStatistics.h"
#include "Output/TetrahedronOutput.h"
#include "Vtk/ReadDataSet.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkPointSet.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

int vtkTIPPDelaunay3D::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!tipp::hasSeveralRanks(this->Controller))
  {
    return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  }
  // Whichever piece is requested, every rank contributes its share of the points.
  tipp::askForRankPiece(inputVector[0]->GetInformationObject(0), this->Controller);
  return 1;
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
    tipp::requireUnused({ { "Alpha", this->Alpha != 0 }, { "Tolerance", this->Tolerance > 0 },
      { "BoundingTriangulation", this->BoundingTriangulation != 0 },
      { "GenerateNeighborIds", this->GenerateNeighborIds != 0 } });
    tipp::Monitor monitor(this);
    tipp::TetrahedralizationOptions options;
    options.Partitions = this->NumberOfPartitions;
    options.Threads = this->NumberOfThreads;
    options.Progress = [&monitor](double fraction) { return monitor(fraction); };
    tipp::checkPoints(input, "the input");
    // Collective steps must be done by all ranks or by none, even if their properties differ.
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
      tipp::addDuplicatesAndRejected(mine.Duplicates, mine.Rejected, output);
    }
    tipp::fillStatisticsTable(tipp::statisticsOf(mine), statistics);
  };
  ranks.together(run);
  this->NumberOfDuplicatePoints = mine.AllDuplicates;
  this->NumberOfRejectedPoints = mine.AllRejected;
  if (ranks.isFirst())
  {
    tipp::warn(this, tipp::warningsOf(mine));
  }
  return true;
}
