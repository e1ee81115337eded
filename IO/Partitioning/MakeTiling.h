// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMakeTiling_h
#define tippMakeTiling_h

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "Partition/BoxTiling.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/Ranks.h"
#include "Partitioning/TilingChoice.h"
#include "Predicates/Point3.h"

#include <cstdint>

namespace tipp
{

/// Returns the chosen tiling of the mesh's domain. While a tree is built, `chunkCells` cells are in
/// memory, with their coordinates twice. Collective. Throws IOError, also for more than mostPieces
/// boxes.
BoxTiling makeTiling(const FlatMesh& mesh, const TilingChoice& choice, const LoaderOptions& loading,
  std::int64_t chunkCells, int threads, const Ranks& ranks, const Box3& domain);

/// Sets the mesh's domain, and adds a piece with unknown counts for each box.
void setPieces(PartitionedMesh& mesh, const Box3& domain, const BoxTiling& tiling);

} // namespace tipp

#endif
