// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionNeighbors_h
#define tippPartitionNeighbors_h

#include "Partitioning/PartitionMesh.h"

namespace tipp
{

/// partitionMesh() with the array NeighborIds besides. Which cells are neighbours is known once the
/// mesh is partitioned: so its cells and points alone are partitioned first, into a scratch folder
/// beside the output; the first rank asks that mesh piece by piece, and writes the ids into a
/// scratch file, 8 bytes a corner, which is partitioned as one more array.
PartitionStatistics partitionWithNeighbors(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options, vtkMultiProcessController* controller);

} // namespace tipp

#endif
