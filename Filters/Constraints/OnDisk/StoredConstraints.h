// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStoredConstraints_h
#define tippStoredConstraints_h

#include "Constraints/ConstraintEdges.h"
#include "Constraints/ConstraintSegments.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/TableConstraints.h"
#include "Points/ReadPoints.h"
#include "Ranks/Spill.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Looks up many positions among the points of a stream, on disk. Positions are sorted into buckets
/// by a hash. So are points that may have one of these positions, as a few bits of the hash tell.
/// Then the buckets are joined one by one. In memory are the bits and one bucket.
class VTKTIPPFILTERS_EXPORT PositionJoin
{
public:
  /// Paths of temporary files begin with `file`. `wanted`: the number of calls of want() that
  /// follow. `columns`: the number of values kept per point. `memory`: in bytes; about an eighth of
  /// it is used.
  PositionJoin(const std::string& file, std::int64_t wanted, std::size_t columns,
    std::uint64_t memory, int threads);

  /// Adds a position to be looked up, which must be finite. `number` identifies it for the caller.
  void want(Point2 position, std::int64_t number);
  /// Call it once, between the last want() and the first add().
  void seal();

  /// Adds the next points of the stream. valueOf(i, column) returns a value of point i.
  template <typename ValueOf>
  void add(PointsView points, const ValueOf& valueOf)
  {
    std::vector<double> row(2 + this->Columns);
    for (const std::size_t i : this->mayMatch(points))
    {
      row[0] = points[i].x;
      row[1] = points[i].y;
      for (std::size_t c = 0; c < this->Columns; ++c)
      {
        row[2 + c] = valueOf(i, c);
      }
      this->Candidates.add(this->bucketOf(points[i]), row.data());
    }
  }

  /// Call it once, after the last point.
  void finish();

  /// The result for one call of want().
  struct Match
  {
    Point2 Position;
    std::int64_t Number;
    std::int64_t First;   ///< number of the first want() with this position
    const double* Values; ///< of the first point at the position; null: no point has it
  };

  /// Calls visit() once per want(); those with equal positions in their order. Requires finish().
  /// May be called several times.
  void forEachMatch(const std::function<void(const Match&)>& visit) const;

private:
  struct WantedPosition
  {
    Point2 Position;
    std::int64_t Number;
  };

  std::size_t bucketOf(Point2 position) const
  {
    return (PositionIndex::hashOf(position) >> 24) % MostBuckets % this->Positions.keys();
  }
  std::uint64_t& wordOf(std::uint64_t hash) { return this->Bits[hash >> 32 & this->Mask]; }
  /// Sets four of 64 bits.
  static std::uint64_t bitsOf(std::uint64_t hash)
  {
    constexpr std::uint64_t one = 1;
    return one << (hash & 63) | one << (hash >> 6 & 63) | one << (hash >> 12 & 63) |
      one << (hash >> 18 & 63);
  }
  std::vector<std::size_t> mayMatch(PointsView points);
  void matchBucket(std::size_t bucket, const std::function<void(const Match&)>& visit) const;

  static constexpr std::size_t MostBuckets = 1024;

  const std::size_t Columns;
  const int Threads;
  std::uint64_t Mask;              ///< for indices of Bits
  std::vector<std::uint64_t> Bits; ///< the filter: a few bits are set for each position
  KeyedRows Positions;             ///< rows of WantedPosition
  KeyedRows Candidates;            ///< points that passed the filter: x, y and values
};

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
    std::vector<Point2> Positions; ///< by index of the end; NaN: the index is unused
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
  const Columns PointColumns;
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
