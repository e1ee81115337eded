// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionNeighbors_h
#define tippPartitionNeighbors_h

#include "Partitioning/PartitionMesh.h"

namespace tipp
{

/// partitionMesh() with the additional array NeighborIds. Neighbours can be found once the mesh is
/// partitioned. So first only its cells and points are partitioned, into a scratch folder beside
/// the output. The first rank then finds the neighbours piece by piece and writes their ids to a
/// scratch file, 8 bytes per corner. Finally the mesh is partitioned with that file as one more
/// array.
PartitionStatistics partitionWithNeighbors(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options, vtkMultiProcessController* controller);

} // namespace tipp

#endif
