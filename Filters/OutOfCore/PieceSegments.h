// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceSegments_h
#define tippPieceSegments_h

#include "Constraints/ConstraintSegments.h"
#include "OutOfCore/PiecePlan.h"
#include "Partitioning/Spill.h"
#include "Ranks/Archive.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// The segments that constrain a triangulation out of core, in a file, sorted by the pieces whose
/// boxes they may meet: a segment is there for each of these. A segment's name is its index among
/// all. Those that tell which triangles are kept are in memory, too.
class VTKTIPPFILTERS_EXPORT PieceSegments
{
public:
  /// Writes the file, whose path begins with `file`. The plan's coordinates are those of the
  /// segments times `factor`; the plan must outlive this. Throws IOError, as all methods do.
  /// forEach(visit) visits all segments.
  PieceSegments(const std::string& file, const PiecePlan& plan, double factor,
    const std::function<void(const VisitSegment&)>& forEach, int threads);

  /// Opens a file of which save() told.
  PieceSegments(
    const std::string& file, const PiecePlan& plan, double factor, LoadArchive& archive);
  void save(SaveArchive& archive) const;

  /// Of a piece.
  std::int64_t count(PartitionIndex piece) const { return this->Rows.rows(std::size_t(piece)); }
  /// What a piece's constraints take in memory while the piece is triangulated.
  std::uint64_t bytesOf(PartitionIndex piece) const;
  /// What `segments` take on disk, if each is in one piece.
  static std::uint64_t fileBytes(std::int64_t segments)
  {
    return sizeof(Row) * std::uint64_t(segments);
  }

  /// The segments that may meet the piece's box.
  ConstraintSegments read(PartitionIndex piece) const;

  /// All segments that meet one of these boxes, and perhaps others whose bounding box overlaps one.
  /// For triangles that lie in several pieces.
  ConstraintSegments readNear(const std::vector<Box2>& boxes) const;

  /// The edges of polygons, boundaries and holes.
  const ConstraintSegments& cutting() const { return this->Cutting; }

private:
  struct Row
  {
    ConstraintSegment Segment;
    std::int64_t Name;
  };

  struct Written
  {
    SpilledRows Rows;
    std::vector<ConstraintSegment> Cutting;
  };

  PieceSegments(
    const std::string& file, const PiecePlan& plan, double factor, const Written& written);
  static Written write(const std::string& file, const PiecePlan& plan, double factor,
    const std::function<void(const VisitSegment&)>& forEach, int threads);
  Box2 planned(const Box2& box) const;
  void visit(PartitionIndex piece, const std::function<void(const Row&)>& visit) const;

  const PiecePlan& Plan;
  const double Factor;
  Spill Rows;
  ConstraintSegments Cutting;
};

} // namespace tipp

#endif
