// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshParts_h
#define tippMeshParts_h

#include "Partitioned/PartitionedMesh.h"

#include <algorithm>
#include <cstdint>

namespace tipp
{

/// Returns the number of parts of about `memory` bytes in which a partitioned mesh is read.
inline int countParts(const PartitionedMesh& mesh, std::uint64_t memory)
{
  /// The approximate memory, in bytes, of a cell: the cell, its share of the points, and its entry
  /// in a search tree.
  constexpr std::uint64_t bytesOfCell = 160;
  std::int64_t cells = 0;
  for (const PieceSummary& piece : mesh.Pieces)
  {
    cells += piece.Cells;
  }
  return int(std::min<std::uint64_t>(bytesOfCell * std::uint64_t(cells) / memory + 1, 1 << 20));
}

} // namespace tipp

#endif
