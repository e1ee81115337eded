// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStoredConstraints_h
#define tippStoredConstraints_h

#include "Constraints/ConstraintPoints.h"
#include "Constraints/ConstraintSegments.h"
#include "Constraints/PositionJoin.h"
#include "Constraints/TableConstraints.h"
#include "Partitioning/StoredRows.h"
#include "Points/PointStream.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Where temporary files go, and how much memory their readers may take.
struct DiskWork
{
  std::string Files; ///< how their paths begin
  std::uint64_t Memory;
  int Threads;
};

/// Constraints on disk, of which no memory holds all, and what the points of a stream have to do
/// with their ends. Numbers are those of the constraints, first the lines', then the boundary's.
///
/// An end is either a vertex of the constraints' own, known by its position, or names a point by
/// its id.
class VTKTIPPFILTERS_EXPORT StoredConstraints
{
public:
  /// What crossing points and new points need of a stream's points.
  struct Columns
  {
    std::vector<std::string> Names;
    /// Of each column, for own vertices that are no points where the file has no height; perhaps
    /// none.
    std::vector<std::vector<double>> Surface;
  };

  /// Writes all to disk. Lines: those of a text file, instead of constraints.Lines; or null. Throws
  /// IOError, as all methods do.
  StoredConstraints(
    DiskWork work, TableConstraints constraints, SegmentRows* lines, Columns columns);

  /// The next points of the stream.
  void add(const PointBlock& block);

  /// After all points. Throws std::invalid_argument for an id that no point has.
  void match();

  std::int64_t count() const { return this->Keys->count(); }
  SegmentRole roleOf(std::int64_t number) const
  {
    return number >= this->BoundaryBegin ? SegmentRole::Boundary
      : number >= this->PolygonBegin     ? SegmentRole::Polygon
                                         : SegmentRole::Line;
  }

  /// @name After match()
  ///@{
  /// Calls visit(number, a, b) with the ends of all constraints, in their order.
  template <typename Visit>
  void forEach(const Visit& visit) const
  {
    const RowFile& ends = this->Places ? *this->Places : *this->Keys;
    ends.forEach<Segment>([&visit](std::int64_t number, const Segment& segment)
      { visit(number, segment.A, segment.B); });
  }

  /// Calls visit(position, values) for the vertices that are no points, each position once, in
  /// their order. They are to follow the stream's points. Values: of each column.
  void forEachNew(const std::function<void(Point2, const double*)>& visit) const;

  /// Ends of some constraints.
  struct Ends
  {
    std::vector<Point2> Positions; ///< of each end, by its index; some indices are not used
    std::vector<Constraint> Edges; ///< the indices of each constraint's ends
    std::size_t OwnCount = 0;      ///< indices before this one are those of Own
    std::unique_ptr<PositionIndex> Own;
    std::unique_ptr<PositionIndex> Named; ///< of ids as x
  };

  /// Of those for which isTaken(number) is true.
  Ends endsOf(const std::function<bool(std::int64_t)>& isTaken) const;

  /// Calls visit(end, id, values) with the id and the values of the point at each end, several
  /// times for some.
  void lookUp(
    const Ends& ends, const std::function<void(std::size_t, PointId, const double*)>& visit) const;
  ///@}

private:
  struct Vertex
  {
    Point2 Position;
    double Height;
  };
  struct Segment
  {
    Point2 A; ///< or the id as x
    Point2 B;
  };

  bool isNamed(std::int64_t number) const
  {
    return number < this->BoundaryBegin ? this->AreLinesNamed : this->IsBoundaryNamed;
  }
  void store(const ConstraintTable& table, bool& isNamed);
  void wantVertices();
  void wantNamed();
  void placeNamed();
  std::vector<double> valuesOf(std::int64_t vertex) const;
  std::vector<double> valuesOf(std::int64_t number, const Vertex& vertex) const;

  const DiskWork Work;
  const Columns Wanted;
  std::int64_t PolygonBegin = 0;
  std::int64_t BoundaryBegin = 0;
  bool AreLinesNamed = false;
  bool IsBoundaryNamed = false;
  std::int64_t Points = 0; ///< of the stream so far
  std::unique_ptr<RowFile> Vertices;
  std::unique_ptr<RowFile> Keys;       ///< Segments as they are given
  std::unique_ptr<RowFile> Places;     ///< their positions; null: they are the keys
  std::vector<bool> IsNew;             ///< of vertices: no point, and the first one at its position
  std::unique_ptr<PositionJoin> Own;   ///< of vertices; values: the point's id, and columns
  std::unique_ptr<PositionJoin> Named; ///< of ids; values: the point's position, and columns
};

} // namespace tipp

#endif
