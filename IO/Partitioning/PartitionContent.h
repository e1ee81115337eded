// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionContent_h
#define tippPartitionContent_h

#include "Flat/WriteFlatMesh.h"
#include "Partitioning/PartitionMesh.h"

#include <functional>
#include <string>

namespace tipp
{

/// As partitionMesh(), for a mesh in memory: the first rank calls `make` and writes its result to a
/// temporary flat mesh beside the output. `name` is for errors. A partitioned mesh's own ids are
/// dropped. Throws IOError, on all ranks if on one.
VTKTIPPIO_EXPORT PartitionStatistics partitionContent(const std::function<FlatContent()>& make,
  const std::string& name, const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

} // namespace tipp

#endif
