// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionInput.h"

#include "Files/IOError.h"
#include "Files/PendingFolder.h"
#include "Files/RequireApart.h"
#include "Flat/FlattenDataSet.h"
#include "Partitioning/PartitionContent.h"
#include "Partitioning/Ranks.h"
#include "Vtk/ReadDataSet.h"

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <string>

namespace tipp
{

PartitionStatistics partitionDataSet(vtkDataSet* data, const std::string& name,
  const std::string& output, const PartitionOptions& options, vtkMultiProcessController* controller)
{
  const auto make = [&] { return flattenDataSet(data, name).Content; };
  return partitionContent(make, name, output, options, controller);
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
        // fails early if the output cannot be written
        const PendingFolder writable(output, &replaceableMesh);
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
