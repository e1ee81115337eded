// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionInput.h"

#include "Files/IOError.h"
#include "Files/PendingFolder.h"
#include "Files/RequireApart.h"
#include "Flat/FlattenDataSet.h"
#include "Flat/WriteFlatMesh.h"
#include "Partitioned/PieceLayout.h"
#include "Partitioning/Ranks.h"
#include "Vtk/ReadDataSet.h"

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

namespace
{

/// Drops the ids of a partitioned mesh that the data set was read from: this one has its own.
void removeOwnIds(FlatContent& content)
{
  const auto drop = [](std::vector<FlatArray>& arrays, const std::string& name)
  {
    arrays.erase(std::remove_if(arrays.begin(), arrays.end(),
                   [&](const FlatArray& array) { return array.Name == name; }),
      arrays.end());
  };
  drop(content.PointData, pointIdsName);
  drop(content.CellData, cellIdsName);
}

} // namespace

PartitionStatistics partitionDataSet(vtkDataSet* data, const std::string& name,
  const std::string& output, const PartitionOptions& options, vtkMultiProcessController* controller)
{
  const Ranks ranks(controller);
  // It goes away with this object, or before the next run if this one is killed.
  std::optional<PendingFolder> scratch;
  std::string folder;
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        scratch.emplace(output, &replaceableMesh);
        folder = scratch->temporaryPath() + "/flat";
        FlatContent content = flattenDataSet(data, name).Content;
        removeOwnIds(content);
        writeFlatMesh(folder, content);
      }
    });
  folder = ranks.broadcast(folder);
  FlatMesh mesh;
  ranks.attempt([&] { mesh = openFlatMesh(folder); });
  return partitionMesh(mesh, output, options, controller);
}

PartitionStatistics partitionInput(const std::string& input, const std::string& output,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  const Ranks ranks(controller);
  FlatMesh mesh;
  vtkSmartPointer<vtkDataSet> data;
  int isFlat = 1;
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        requireApart({ output }, { input });
        const PendingFolder writable(output, &replaceableMesh); // before the work
      }
      isFlat = isFlatMesh(input) || !isVtkFile(input);
      if (isFlat)
      {
        mesh = openFlatMesh(input);
      }
      else if (ranks.isFirst())
      {
        data = readDataSet(input);
      }
    });
  return isFlat ? partitionMesh(mesh, output, options, controller)
                : partitionDataSet(data, input, output, options, controller);
}

} // namespace tipp
