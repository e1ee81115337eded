// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStoredConstraints_h
#define tippStoredConstraints_h

#include "Constraints/ConstraintPoints.h"
#include "Constraints/ConstraintSegments.h"
#include "Constraints/OnDisk/PositionJoin.h"
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

/// Where temporary files are written, and how much memory the work on them may take.
struct DiskWork
{
  std::string Files;    ///< the paths begin with this
  std::uint64_t Memory; ///< in bytes
  int Threads;
};

/// Constraints in temporary files, which may be larger than memory, matched with the points of a
/// stream. Constraints are identified by their numbers: lines first, then those of the boundary.
///
/// An end of a constraint is either a vertex with a position of its own or the id of a point.
class VTKTIPPFILTERS_EXPORT StoredConstraints
{
public:
  /// The columns of the stream's points, which crossing points and new points also get.
  struct Columns
  {
    std::vector<std::string> Names;
    /// Per column, a value for each vertex. Used for a vertex that is no point of the stream and
    /// has no height in the file. May be empty.
    std::vector<std::vector<double>> Surface;
  };

  /// Writes the constraints to disk. `lines`: lines of a text file, used instead of
  /// constraints.Lines; or null. Throws IOError, as all methods do.
  StoredConstraints(
    DiskWork work, TableConstraints constraints, SegmentRows* lines, Columns columns);

  /// Adds the next points of the stream.
  void add(const PointBlock& block);

  /// Matches ends with points. Call it once, after all points. Throws std::invalid_argument for an
  /// id that no point has.
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
  /// Calls visit(number, a, b) with the positions of the ends, for all constraints by number.
  template <typename Visit>
  void forEach(const Visit& visit) const
  {
    const RowFile& ends = this->Places ? *this->Places : *this->Keys;
    ends.forEach<Segment>([&visit](std::int64_t number, const Segment& segment)
      { visit(number, segment.A, segment.B); });
  }

  /// Calls visit(position, values) for the vertices that are no points of the stream, in their
  /// order, each position once. They follow the stream's points. `values`: one per column.
  void forEachNew(const std::function<void(Point2, const double*)>& visit) const;

  /// Ends of some constraints.
  struct Ends
  {
    std::vector<Point2> Positions; ///< by index of the end; some indices are unused
    std::vector<Constraint> Edges; ///< per constraint, the indices of its ends
    std::size_t OwnCount = 0;      ///< lower indices are those of Own
    std::unique_ptr<PositionIndex> Own;
    std::unique_ptr<PositionIndex> Named; ///< x is the point's id
  };

  /// Returns the ends of the constraints for which isTaken(number) is true.
  Ends endsOf(const std::function<bool(std::int64_t)>& isTaken) const;

  /// Calls visit(end, id, values) with the id and the column values of the point at each end. May
  /// visit an end several times.
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
    Point2 A; ///< position, or id as x
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
  std::int64_t newBefore(std::int64_t vertex) const;
  std::vector<double> valuesOf(std::int64_t vertex) const;
  std::vector<double> valuesOf(std::int64_t number, const Vertex& vertex) const;

  static constexpr std::size_t VerticesPerCount = 4096;

  const DiskWork Work;
  const Columns Wanted;
  std::int64_t PolygonBegin = 0;
  std::int64_t BoundaryBegin = 0;
  bool AreLinesNamed = false;
  bool IsBoundaryNamed = false;
  std::int64_t Points = 0; ///< number of points of the stream so far
  std::unique_ptr<RowFile> Vertices;
  std::unique_ptr<RowFile> Keys;       ///< of Segment, as given
  std::unique_ptr<RowFile> Places;     ///< of Segment, with positions; null: Keys has these
  std::vector<bool> IsNew;             ///< by vertex: no point, and the first at its position
  std::vector<std::int64_t> NewBefore; ///< new vertices before each VerticesPerCount vertices
  std::unique_ptr<PositionJoin> Own;   ///< vertices; values: the point's id, then the columns
  std::unique_ptr<PositionJoin> Named; ///< ids; values: the point's position, then the columns
};

} // namespace tipp

#endif
