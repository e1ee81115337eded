// SPDX-License-Identifier: BSD-3-Clause
#include "Output/RankTable.h"

#include "Output/TableArrays.h"

#include "vtkDoubleArray.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

namespace tipp
{

void fillRankTable(const DistributedTriangulation& mine, vtkTable* table)
{
  using Rank = RankStatistics;
  const DistributedStatistics& statistics = mine.Statistics;
  const bool hasMaster = !statistics.Masters.empty() && statistics.Masters.front().Area == 0;
  const MasterStatistics none;
  const MasterStatistics& master = hasMaster ? statistics.Masters.front() : none;
  addStages(master.Stages, table);

  vtkFieldData* totals = table->GetFieldData();
  addTotal("Points", mine.AllPoints, totals);
  addTotal("Triangles", mine.AllTriangles, totals);
  addTotal("DuplicatePoints", mine.AllDuplicates, totals);
  addTotal("RejectedPoints", mine.AllRejected, totals);
  addTotal("Partitions", statistics.Partitions, totals);
  addTotal("MajorPartitions", statistics.MajorPartitions, totals);
  addTotal("Threads", statistics.ThreadsPerRank, totals);
  addTotal("LargestMasterMesh", master.LargestMesh, totals);
  const auto seconds = [&](const char* name, double Rank::*figure)
  {
    totals->AddArray(arrayOf<vtkDoubleArray>(
      name, statistics.Ranks, [figure](const Rank& rank) { return rank.*figure; }));
  };
  seconds("RankComputeSeconds", &Rank::ComputeSeconds);
  seconds("RankWaitSeconds", &Rank::WaitSeconds);
  seconds("RankSendSeconds", &Rank::SendSeconds);
  seconds("RankMasterSeconds", &Rank::MasterSeconds);
  seconds("RankSubMasterSeconds", &Rank::SubMasterSeconds);
  totals->AddArray(
    idsOf("RankOwnedPoints", statistics.Ranks, [](const Rank& r) { return r.OwnedPoints; }));
  totals->AddArray(
    idsOf("RankTriangles", statistics.Ranks, [](const Rank& r) { return r.Triangles; }));
  totals->AddArray(arrayOf<vtkDoubleArray>(
    "MasterSeconds", std::vector<double>{ master.Seconds }, [](double value) { return value; }));
  using Traffic = TrafficStatistics;
  totals->AddArray(arrayOf<vtkStringArray>(
    "MessageKind", statistics.Traffic, [](const Traffic& t) { return t.Kind; }));
  totals->AddArray(
    idsOf("MessageCount", statistics.Traffic, [](const Traffic& t) { return t.Messages; }));
  totals->AddArray(
    idsOf("MessageBytes", statistics.Traffic, [](const Traffic& t) { return t.Bytes; }));
}

void addAccounts(const DistributedTriangulation& mine, vtkPolyData* output)
{
  vtkFieldData* data = output->GetFieldData();
  data->AddArray(idsOf("DuplicatePointIds", mine.Duplicates,
    [](const Duplicate& duplicate) { return duplicate.Point; }));
  data->AddArray(idsOf("DuplicateRepresentativeIds", mine.Duplicates,
    [](const Duplicate& duplicate) { return duplicate.Representative; }));
  data->AddArray(idsOf("RejectedPointIds", mine.Rejected, [](PointId id) { return id; }));
}

} // namespace tipp
