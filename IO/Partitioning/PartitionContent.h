// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionContent_h
#define tippPartitionContent_h

#include "Flat/WriteFlatMesh.h"
#include "Partitioning/PartitionMesh.h"

#include <functional>
#include <string>

namespace tipp
{

/// partitionMesh for a mesh in memory, which the first rank makes and lays down as a flat mesh
/// beside the output for as long as the run lasts; `name` is for errors. A partitioned mesh's own
/// ids are dropped. Throws IOError, on all ranks if on one.
VTKTIPPIO_EXPORT PartitionStatistics partitionContent(const std::function<FlatContent()>& make,
  const std::string& name, const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

} // namespace tipp

#endif
