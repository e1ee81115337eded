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

/// Finds the pieces that own cells or points of a stored mesh by their global ids. The ids are in
/// no index: those of the pieces are read, and of each piece their range is remembered, so that
/// later calls read only pieces that may have an id.
class PieceIds
{
public:
  explicit PieceIds(const PartitionedMesh& mesh)
    : Mesh(mesh)
  {
  }

  /// -1: none of the pieces [first, end) owns it. Throws IOError. Several threads may call it.
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
  mutable std::vector<Range> Ranges[2]; ///< of cells, of points
};

} // namespace tipp

#endif
