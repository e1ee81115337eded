// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionInput_h
#define tippPartitionInput_h

#include "Partitioning/PartitionMesh.h"
#include "vtkTIPPIOModule.h"

#include <string>

class vtkMultiProcessController;

namespace tipp
{

/// partitionMesh for a flat mesh, or for any file of VTK's that readDataSet knows, which the first
/// rank reads and lays down as a flat mesh beside the output for as long as the run lasts. Throws
/// IOError, on all ranks if on one.
VTKTIPPIO_EXPORT PartitionStatistics partitionInput(const std::string& input,
  const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

} // namespace tipp

#endif
