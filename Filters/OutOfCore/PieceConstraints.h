// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceConstraints_h
#define tippPieceConstraints_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/Insertion/CrossedPart.h"
#include "Constraints/Insertion/PartitionConstraints.h"
#include "OutOfCore/PiecePlan.h"
#include "Ranks/Archive.h"
#include "Ranks/Spill.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// The constraint segments of a triangulation out of core, in a file. They are sorted by piece: a
/// segment is stored for each piece whose box it may meet. A segment is identified by its index in
/// the list of all segments. The segments that decide which triangles are kept are also in memory.
class VTKTIPPFILTERS_EXPORT PieceSegments
{
public:
  /// Writes the file; its path begins with `file`. forEach(visit) visits all segments. The plan has
  /// the coordinates of the segments multiplied by `factor`. The plan must outlive this object.
  /// Throws IOError, as all methods do.
  PieceSegments(const std::string& file, const PiecePlan& plan, double factor,
    const std::function<void(const VisitSegment&)>& forEach, int threads);

  /// Opens a file that another process has written and described with save().
  PieceSegments(
    const std::string& file, const PiecePlan& plan, double factor, LoadArchive& archive);
  void save(SaveArchive& archive) const;

  /// Returns the number of segments stored for a piece.
  std::int64_t count(PartitionIndex piece) const { return this->Rows->rows(std::size_t(piece)); }
  /// Returns the bytes of memory that a piece's constraints need while the piece is triangulated.
  std::uint64_t bytesOf(PartitionIndex piece) const;
  /// Returns the bytes on disk of this many segments if each is in one piece.
  static std::uint64_t fileBytes(std::int64_t segments)
  {
    return sizeof(Row) * std::uint64_t(segments);
  }

  /// Returns the segments that may meet the piece's box.
  ConstraintSegments read(PartitionIndex piece) const;

  /// Returns all segments that meet one of these boxes, and perhaps others whose bounding box
  /// overlaps one. For triangles that lie in several pieces. Boxes are in the coordinates of the
  /// segments.
  ConstraintSegments readNear(const std::vector<Box2>& boxes) const;

  /// Returns the edges of polygons, boundaries and holes.
  const ConstraintSegments& cutting() const { return this->Cutting; }

private:
  struct Row
  {
    ConstraintSegment Segment;
    std::int64_t Name;
  };

  void visit(PartitionIndex piece, const std::function<void(const Row&)>& visit) const;

  const PiecePlan& Plan;
  const double Factor;
  std::unique_ptr<Spill> Rows;
  ConstraintSegments Cutting;
};

/// The constraint segments near a piece that is in memory. A segment between two of its points is
/// inserted while the partitions are triangulated, if it crosses only interior triangles of one
/// partition. Points are identified by their index in the piece.
class PieceConstraints
{
public:
  /// `points` are the piece's points, and must outlive this object. `partitions` divides the piece;
  /// like the kernels, it has the points' coordinates multiplied by `factor`.
  PieceConstraints(
    ConstraintSegments segments, PointsView points, double factor, const Tiling& partitions);

  /// Returns an editor for a thread's worker. This object must outlive it.
  std::unique_ptr<PartitionEditor> makeEditor() { return this->Inserted->makeEditor(); }

  /// Call this when all partitions are triangulated, before the methods below. `representatives`:
  /// for each point that coincides with another one, the point that represents both in triangles.
  void finishInserting(const std::unordered_map<std::int32_t, std::int32_t>& representatives);

  /// Removes the triangles that are crossed by segments not yet inserted, and adds them to `part`,
  /// where vertex ids are indices plus `first`. The other triangles keep their order. `bucket`: the
  /// index in the piece of the partition whose interior triangles these are, or -1. Returns the
  /// number of remaining triangles.
  std::size_t takeCrossed(PartitionIndex bucket, std::int64_t first, std::int32_t* corners,
    std::size_t triangles, CrossedPart& part) const;

  /// Call this after takeCrossed() of all triangles. Adds to `part` the triangles' edges that lie
  /// on segments, and the vertices in the interior of segments.
  void addEdgesAndTouches(std::int64_t first, CrossedPart& part) const;

private:
  const ConstraintSegments Segments;
  const PointsView Points;
  std::vector<ConstraintPiece> Pieces; ///< the same segments, for PartitionConstraints
  std::unique_ptr<PartitionConstraints> Inserted;
  std::vector<std::int64_t> Remaining; ///< indices of the segments that were not inserted
  ConstraintSegments Left;             ///< these segments
};

} // namespace tipp

#endif
