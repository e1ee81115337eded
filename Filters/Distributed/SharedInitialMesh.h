// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSharedInitialMesh_h
#define tippSharedInitialMesh_h

#include "Engine/PartitionOrder.h"
#include "Ranks/Communicator.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// Sorts the vertices by partition, and of several at a position keeps the one with the lowest id:
/// all ranks must insert the same one, of initial and of artificial points.
VTKTIPPFILTERS_EXPORT void keepOneOfEachPosition(std::vector<BoundaryVertex>& vertices);

/// A part of the initial mesh: all its triangles that meet some partitions, and their neighbours.
///
/// It is made without the rest. A triangulation of all initial points of some partitions and of a
/// few points of the others has triangles that are not in the initial mesh. Those that meet a
/// chosen partition, and their neighbours, are in it once all initial points of the partitions
/// that they meet are inserted: no other point is in their circumdisks. Then none is missing.
/// (Proof. Let x be a point of a chosen region, or next to one on a circumdisk that only touches
/// it. The triangles of the initial mesh that are in conflict with x are connected by edges, and
/// one of them, the one that contains x, is in both meshes, as are all of the local mesh that are
/// in conflict with x. The neighbours of these are in both meshes, so all can be reached.)
struct InitialMeshPart
{
  /// Computes the part for the partitions p with `isChosen[p]`. `initial` has all partitions'
  /// initial points, as keepOneOfEachPosition() leaves those of a partition.
  VTKTIPPFILTERS_EXPORT InitialMeshPart(const Regions& regions,
    const std::vector<BoundaryVertex>& initial, const std::vector<BoundaryVertex>& artificial,
    const std::vector<char>& isChosen, int threads);

  /// Adds to `triangles` and `met` what partitionsPay() needs. Over parts that choose each
  /// partition once the sums are those of the whole mesh.
  VTKTIPPFILTERS_EXPORT void countMet(std::int64_t& triangles, std::int64_t& met) const;

  /// Writes the chosen partitions' conflicts. Takes long where partitions do not pay.
  VTKTIPPFILTERS_EXPORT void writeConflicts(SaveArchive& writer) const;

  BoundaryTriangles Mesh;
  std::vector<char> IsChosen;
};

/// Reads what the ranks wrote with writeConflicts(), concatenated, and returns all conflicts as
/// findConflicts() does. Each partition must have been chosen once. Throws std::runtime_error if
/// the bytes are damaged.
VTKTIPPFILTERS_EXPORT std::optional<ConflictGraph> readConflicts(
  const Bytes& all, std::size_t partitions);

/// Returns all ranks' bytes, concatenated by rank, on all ranks. Collective.
Bytes joinedOnAllRanks(Communicator& ranks, Bytes&& own);

} // namespace tipp

#endif
