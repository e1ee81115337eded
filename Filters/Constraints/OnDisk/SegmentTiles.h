// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSegmentTiles_h
#define tippSegmentTiles_h

#include "Constraints/SegmentTree.h"
#include "Partitioning/StoredRows.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace tipp
{

/// Segments on disk, sorted by tiles: boxes with about equally many segments. A segment is stored
/// in each tile that it comes near. In memory are the segments of one tile.
class VTKTIPPFILTERS_EXPORT SegmentTiles
{
public:
  using Visit = std::function<void(const SegmentTree::Item&)>;

  /// Returns how many tiles are needed so that one tile takes a small part of `memory` bytes.
  static int tilesFor(std::int64_t segments, std::uint64_t memory);

  /// Paths of temporary files begin with `file`. forEach(visit) visits all segments, always in the
  /// same order; it is called twice. `segments`: their number. Their ends must be finite.
  SegmentTiles(const std::string& file, const std::function<void(const Visit&)>& forEach,
    std::int64_t segments, int tiles, int threads);

  /// Calls found(one, other) with the Ids of each two segments that cross, the lower first. A pair
  /// that crosses near the border of a tile may be found several times.
  void findCrossings(const std::function<void(std::int64_t, std::int64_t)>& found) const;

  /// Calls near(id) for each segment near one for which isWanted(id) is true, and for that one
  /// itself. Finds all at a distance below 128 units in the last place of the largest coordinate,
  /// and some that are farther. May find a segment several times.
  void findNear(const std::function<bool(std::int64_t)>& isWanted,
    const std::function<void(std::int64_t)>& near) const;

private:
  std::vector<SegmentTree::Item> itemsOf(std::size_t tile) const;

  const int Threads;
  double Margin = 0; ///< the distance that counts as near
  std::unique_ptr<KeyedRows> Rows;
};

} // namespace tipp

#endif
