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

/// Segments on disk by tiles, boxes that hold about equally many: a segment is in each tile that it
/// may come near. Memory: the segments of a tile.
class VTKTIPPFILTERS_EXPORT SegmentTiles
{
public:
  using Visit = std::function<void(const SegmentTree::Item&)>;

  /// About how many tiles there must be so that those of one take a part of `memory` bytes.
  static int tilesFor(std::int64_t segments, std::uint64_t memory);

  /// Temporary files' paths begin with `file`. forEach(visit) visits all `segments` ones in an
  /// order that is always the same; it is called twice. Their ends are finite.
  SegmentTiles(const std::string& file, const std::function<void(const Visit&)>& forEach,
    std::int64_t segments, int tiles, int threads);

  /// Calls found(one, other) with the Ids of two segments that cross, the lower first. Two that
  /// cross near a tile's border may be found again.
  void findCrossings(const std::function<void(std::int64_t, std::int64_t)>& found) const;

  /// Calls near(id) for all segments that come near one for which isWanted(id) is true, which is
  /// near itself: nearer than 128 units in the last place of the largest coordinate. A segment may
  /// be found again.
  void findNear(const std::function<bool(std::int64_t)>& isWanted,
    const std::function<void(std::int64_t)>& near) const;

private:
  std::vector<SegmentTree::Item> itemsOf(std::size_t tile) const;

  const int Threads;
  double Margin = 0; ///< what is near
  std::unique_ptr<KeyedRows> Rows;
};

} // namespace tipp

#endif
