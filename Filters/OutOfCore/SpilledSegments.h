// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpilledSegments_h
#define tippSpilledSegments_h

#include "Constraints/ConstraintSegments.h"
#include "OutOfCore/PiecePlan.h"
#include "Ranks/Archive.h"
#include "Ranks/Spill.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// The constraint segments of a triangulation out of core, in a file. They are sorted by piece: a
/// segment is stored for each piece whose box it may meet. A segment is identified by its index in
/// the list of all segments. The segments that decide which triangles are kept are also in memory.
class VTKTIPPFILTERS_EXPORT SpilledSegments
{
public:
  /// Writes the file; its path begins with `file`. forEach(visit) visits all segments. The plan has
  /// the coordinates of the segments multiplied by `factor`. The plan must outlive this object.
  /// Throws IOError, as all methods do.
  SpilledSegments(const std::string& file, const PiecePlan& plan, double factor,
    const std::function<void(const VisitSegment&)>& forEach, int threads);

  /// Opens a file that another process has written and described with save().
  SpilledSegments(
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

} // namespace tipp

#endif
