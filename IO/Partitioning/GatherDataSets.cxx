// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/GatherDataSets.h"

#include "Files/IOError.h"
#include "Partitioning/Ranks.h"
#include "Vtk/CheckDataSet.h"

#include "vtkAppendFilter.h"
#include "vtkDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkUnstructuredGrid.h"

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
  const Ranks ranks(controller);
  DataSets sets = dataSetsIn(data);
  ranks.attempt(
    [&]
    {
      for (const vtkSmartPointer<vtkDataSet>& set : sets)
      {
        checkDataSet(set, "the input");
      }
    });
  const std::int64_t count = ranks.sum({ std::int64_t(sets.size()) })[0];
  if (count == 0)
  {
    throw IOError("There is no data set to partition; set an input or InputFileName.");
  }
  if (ranks.count() == 1)
  {
    return unite(sets);
  }
  vtkSmartPointer<vtkDataSet> mine;
  if (sets.empty())
  {
    mine = vtkSmartPointer<vtkUnstructuredGrid>::New();
  }
  else
  {
    mine = unite(sets);
  }
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

} // namespace tipp
