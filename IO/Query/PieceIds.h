// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceIds_h
#define tippPieceIds_h

#include "Partitioned/PartitionedMesh.h"

#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace tipp
{

/// Finds the pieces that own cells or points of a stored mesh, by global ids. The mesh has no index
/// of ids, so the id arrays of pieces are read. The range of each piece's ids is remembered, so
/// that later calls read only pieces that may own an id.
class PieceIds
{
public:
  explicit PieceIds(const PartitionedMesh& mesh)
    : Mesh(mesh)
  {
  }

  /// For each global id, the piece of [first, end) that owns it, or -1. Throws IOError.
  /// Thread-safe.
  std::vector<std::int32_t> find(const std::vector<std::int64_t>& ids, bool ofPoints, int threads,
    std::size_t first, std::size_t end) const;

private:
  struct Range
  {
    std::int64_t Low = 0;
    std::int64_t High = INT64_MAX;
  };

  std::vector<std::int64_t> read(std::size_t piece, bool ofPoints) const;

  const PartitionedMesh& Mesh;
  mutable std::mutex Mutex;
  mutable std::vector<Range> Ranges[2]; ///< ranges of cells, ranges of points; by piece
};

} // namespace tipp

#endif
