// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSplitStored_h
#define tippSplitStored_h

#include "Constraints/OnDisk/StoredConstraints.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/SegmentTree.h"
#include "Ranks/Spill.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Segments on disk, sorted by tiles: boxes with about equally many segments. A segment is stored
/// in each tile that it comes near. In memory are the segments of one tile.
class VTKTIPPFILTERS_EXPORT SegmentTiles
{
public:
  using Visit = std::function<void(const SegmentTree::Item&)>;

  /// Paths of temporary files begin with `file`. forEach(visit) visits all segments, always in the
  /// same order; it is called twice. Their ends must be finite.
  SegmentTiles(const std::string& file, const std::function<void(const Visit&)>& forEach, int tiles,
    int threads);

  /// Calls found(one, other) with the Ids of each two segments that cross, the lower first. A pair
  /// that crosses near the border of a tile may be found several times.
  void findCrossings(const std::function<void(std::int64_t, std::int64_t)>& found) const;

  /// Calls near(id) for each segment for which isWanted(id) is true, and for each segment near one
  /// of these. Finds all whose distance is below 128 times the spacing of doubles at the largest
  /// coordinate, and some that are farther away. May find a segment several times.
  void findNear(const std::function<bool(std::int64_t)>& isWanted,
    const std::function<void(std::int64_t)>& near) const;

  /// Calls covered(id, end) for each segment of which a part lies on others that begin before it in
  /// lexicographic order; of those that begin at one point, the longest is the first. They cover it
  /// from its lower end to `end`, which may be its higher end. So the parts that are left of all
  /// segments do not overlap, and make up all segments.
  void findCovered(const std::function<void(std::int64_t, Point2)>& covered) const;

  /// The number of tiles so that each takes a small part of the memory, which is in bytes.
  static int tilesFor(std::int64_t segments, std::uint64_t memory);

  /// The distance that counts as near.
  double margin() const { return this->Margin; }

private:
  const int Threads;
  double Margin = 0;
  Tiling Boxes;
  std::unique_ptr<KeyedRows> Rows;
};

/// The result of splitting constraints on disk where they cross.
struct SplitConstraints
{
  /// A part of a constraint.
  struct Part
  {
    std::int64_t Number; ///< number of the constraint
    Point2 A;
    Point2 B;
  };
  std::vector<Part> Parts;                 ///< of split constraints, by number, then along them
  std::vector<Point2> Crossings;           ///< the new points
  std::vector<std::vector<double>> Values; ///< per column, a value for each of these
  int Rounds = 0;                          ///< of splitting
};

/// Visits all points before crossings, block by block, in the order of their ids.
using VisitBlocks = std::function<void(const std::function<void(const PointBlock&)>&)>;

/// Splits constraints where they cross, with the result of resolveCrossings() for all of them.
/// Finds the constraints that cross others, tile by tile. Only these, constraints so near that
/// rounding may matter, and the points on them are then passed to resolveCrossings(). For the
/// points, all points are visited once more if there are crossings. Omits constraints with an end
/// that is not finite, or with equal ends. Throws as resolveCrossings() does.
SplitConstraints splitStored(const StoredConstraints& constraints, const VisitBlocks& forEachBlock,
  CrossingRule rule, std::size_t columns, const DiskWork& work);

} // namespace tipp

#endif
