// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionInput_h
#define tippPartitionInput_h

#include "Partitioning/PartitionMesh.h"
#include "vtkTIPPIOModule.h"

#include <string>

class vtkDataSet;
class vtkMultiProcessController;

namespace tipp
{

/// As partitionMesh(), for a flat mesh or any file that readDataSet() supports, which the first
/// rank reads. Throws IOError, on all ranks if on one.
VTKTIPPIO_EXPORT PartitionStatistics partitionInput(const std::string& input,
  const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

/// As partitionMesh(), for the first rank's data set (null on the others), which is written to a
/// temporary flat mesh beside the output; `name` is for errors. Cells other than triangles and
/// tetrahedra are cut into these; ghosts and a partitioned mesh's ids are dropped.
VTKTIPPIO_EXPORT PartitionStatistics partitionDataSet(vtkDataSet* data, const std::string& name,
  const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

} // namespace tipp

#endif
