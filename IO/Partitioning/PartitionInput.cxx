// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionInput.h"

#include "Files/IOError.h"
#include "Partitioning/Ranks.h"

namespace tipp
{

PartitionStatistics partitionInput(const std::string& input, const std::string& output,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  const Ranks ranks(controller);
  FlatMesh mesh;
  ranks.attempt([&] { mesh = openFlatMesh(input); });
  return partitionMesh(mesh, output, options, controller);
}

} // namespace tipp
