// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMakeTiling_h
#define tippMakeTiling_h

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "Partition/BoxTiling.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/Ranks.h"
#include "Partitioning/TilingChoice.h"
#include "Predicates/Box3.h"

#include <cstdint>

namespace tipp
{

/// The chosen tiling of the mesh's domain. `chunkCells` are held at once, with all coordinates
/// twice, while a tree is made. A call of all ranks. Throws IOError, for more than mostPieces boxes
/// too.
BoxTiling makeTiling(const FlatMesh& mesh, const TilingChoice& choice, const LoaderOptions& loading,
  std::int64_t chunkCells, int threads, const Ranks& ranks, const Box3& domain);

/// Gives the mesh the domain and a piece, whose counts are not known yet, for each box.
void setPieces(PartitionedMesh& mesh, const Box3& domain, const BoxTiling& tiling);

} // namespace tipp

#endif
