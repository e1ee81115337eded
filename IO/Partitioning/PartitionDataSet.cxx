// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionMesh.h"

#include "Files/IOError.h"
#include "Flat/FlattenDataSet.h"
#include "Ranks/Communicator.h"
#include "Vtk/DataSets.h"

#include "vtkAppendFilter.h"
#include "vtkDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <string>
#include <vector>

namespace tipp
{
namespace
{

using DataSets = std::vector<vtkSmartPointer<vtkDataSet>>;

DataSets dataSetsIn(vtkDataObject* data)
{
  DataSets sets;
  if (auto* const one = vtkDataSet::SafeDownCast(data))
  {
    sets.emplace_back(one);
  }
  else if (auto* const parts = vtkPartitionedDataSet::SafeDownCast(data))
  {
    for (unsigned int i = 0; i < parts->GetNumberOfPartitions(); ++i)
    {
      if (parts->GetPartition(i))
      {
        sets.emplace_back(parts->GetPartition(i));
      }
    }
  }
  return sets;
}

vtkSmartPointer<vtkDataSet> unite(const DataSets& sets)
{
  if (sets.size() == 1)
  {
    return sets[0];
  }
  vtkNew<vtkAppendFilter> append;
  append->MergePointsOn();
  append->SetTolerance(0);
  for (const vtkSmartPointer<vtkDataSet>& set : sets)
  {
    append->AddInputData(set);
  }
  append->Update();
  return append->GetOutput();
}

} // namespace

vtkSmartPointer<vtkDataSet> gatherDataSets(
  vtkDataObject* data, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  DataSets sets = dataSetsIn(data);
  ranks.attempt(
    [&]
    {
      for (const vtkSmartPointer<vtkDataSet>& set : sets)
      {
        checkDataSet(set, "the input");
      }
    });
  if (!isTrueOnAny(ranks, !sets.empty()))
  {
    throw IOError("There is no data set to partition; set an input or InputFileName.");
  }
  if (ranks.size() == 1)
  {
    return unite(sets);
  }
  if (sets.empty())
  {
    sets.push_back(vtkSmartPointer<vtkUnstructuredGrid>::New());
  }
  const vtkSmartPointer<vtkDataSet> mine = unite(sets);
  std::vector<vtkSmartPointer<vtkDataObject>> all;
  controller->Gather(mine, all, 0);
  DataSets received;
  for (const vtkSmartPointer<vtkDataObject>& object : all)
  {
    auto* const set = vtkDataSet::SafeDownCast(object);
    if (set && set->GetNumberOfCells() > 0)
    {
      received.emplace_back(set);
    }
  }
  // If there is no data set at all, flattening it fails.
  return ranks.isFirst() ? (received.empty() ? mine : unite(received)) : nullptr;
}

PartitionStatistics partitionDataSet(vtkDataSet* data, const std::string& name,
  const std::string& output, const PartitionOptions& options, vtkMultiProcessController* controller)
{
  Flattened flattened;
  const auto make = [&]
  {
    flattened = flattenDataSet(data, name);
    return std::move(flattened.Content);
  };
  PartitionStatistics statistics = partitionInMemory(make, name, output, options, controller);
  statistics.LeftOut = std::move(flattened.LeftOut);
  statistics.GhostCells = flattened.GhostCells;
  return statistics;
}

PartitionStatistics partitionVtkFile(const std::string& input, const std::string& output,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  vtkSmartPointer<vtkDataSet> data;
  ranks.attempt([&] { data = ranks.isFirst() ? readDataSet(input) : nullptr; });
  return partitionDataSet(data, input, output, options, controller);
}

} // namespace tipp
