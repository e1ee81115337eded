// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSharedInitialMesh_h
#define tippSharedInitialMesh_h

#include "Engine/PartitionSchedule.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/Tiling.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// Sorts the vertices by partition and, of several at the same position, keeps the one with the
/// lowest id, so that all ranks insert the same vertices. Applies to initial and to artificial
/// points.
VTKTIPPFILTERS_EXPORT void keepOneOfEachPosition(std::vector<BoundaryVertex>& vertices);

/// The conflicts of some partitions.
struct PartConflicts
{
  struct Row
  {
    PartitionIndex Partition;
    std::vector<PartitionIndex> Neighbours;
  };

  bool IsTotal = false; ///< nearly all partitions conflict
  std::vector<Row> Rows;
};

template <typename Archive>
void serialize(Archive& archive, PartConflicts::Row& row)
{
  archive(row.Partition, row.Neighbours);
}

template <typename Archive>
void serialize(Archive& archive, PartConflicts& conflicts)
{
  archive(conflicts.IsTotal, conflicts.Rows);
}

/// A part of the initial mesh: all its triangles that meet some partitions, and their neighbours.
///
/// It is computed without the rest of the initial mesh. A triangulation of all initial points of
/// some partitions and of a few points of the others has triangles that are not in the initial
/// mesh. But those that meet a chosen partition, and their neighbours, are in it as soon as all
/// initial points of the partitions that they meet are inserted, since no other point is in their
/// circumdisks. Then none of them is missing. (Proof. Let x be a point of a chosen region, or next
/// to one on a circumdisk that only touches it. The triangles of the initial mesh that are in
/// conflict with x are connected by edges, and one of them, the one that contains x, is in both
/// meshes, as are all of the local mesh that are in conflict with x. The neighbours of these are in
/// both meshes, so all can be reached.)
struct InitialMeshPart
{
  /// Computes the part for the partitions p with `isChosen[p]`. `initial` has all partitions'
  /// initial points, after keepOneOfEachPosition().
  VTKTIPPFILTERS_EXPORT InitialMeshPart(const Regions& regions,
    const std::vector<BoundaryVertex>& initial, const std::vector<BoundaryVertex>& artificial,
    const std::vector<char>& isChosen, int threads);

  /// Adds this part's counts for partitionsPay() to `triangles` and `met`. If every partition is
  /// chosen in exactly one part, the sums over all parts equal the counts for the whole mesh.
  VTKTIPPFILTERS_EXPORT void countMet(std::int64_t& triangles, std::int64_t& met) const;

  /// Returns the chosen partitions' conflicts. Slow if partitioning does not pay off.
  VTKTIPPFILTERS_EXPORT PartConflicts conflicts() const;

  BoundaryTriangles Mesh;
  std::vector<char> IsChosen; ///< by partition
};

/// Returns all conflicts as findConflicts() does. Each partition must have been chosen in exactly
/// one part. Throws std::runtime_error if a partition is not below `partitions`.
VTKTIPPFILTERS_EXPORT std::optional<ConflictGraph> joinConflicts(
  const std::vector<PartConflicts>& parts, std::size_t partitions);

} // namespace tipp

#endif
