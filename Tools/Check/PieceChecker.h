// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceChecker_h
#define tippPieceChecker_h

#include "Check/DelaunayChecker.h"
#include "Check/ExactTests.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tipp
{

/// One piece of a mesh, including the triangles that other pieces own but that have one of its
/// points.
struct CheckedPiece
{
  std::vector<double> XY;              ///< of its points, including ghost points
  std::vector<std::int64_t> Ids;       ///< global ids of the points
  std::vector<bool> IsOwn;             ///< per point: whether the piece owns it
  std::vector<std::int32_t> Triangles; ///< three indices in the piece each
  std::int64_t OwnTriangles = 0;       ///< number of own triangles, which come first
  std::vector<std::int64_t> CellIds;   ///< global ids of the own triangles
  /// global ids of their neighbours, one opposite each corner; empty: not stored
  std::vector<std::int64_t> Neighbors;
};

/// checkDelaunay() of a mesh that is added piece by piece: only one piece and the edges between
/// pieces are in memory.
class PieceChecker
{
public:
  /// Given: points with ids from here on are not among those that pointSum() and givenPoints()
  /// are of.
  explicit PieceChecker(
    const CheckOptions& options, std::int64_t given = std::numeric_limits<std::int64_t>::max())
    : Options(options)
    , Given(given)
  {
  }

  void add(const CheckedPiece& piece);
  /// Call after all pieces.
  CheckReport finish();

  /// A hash of the ids and coordinates of the given points that pieces own: equal sums mean equal
  /// points, except with a probability of 2^-64.
  std::uint64_t pointSum() const { return this->PointSum; }
  std::int64_t givenPoints() const { return this->GivenPoints; }
  static std::uint64_t hashPoint(std::int64_t id, double x, double y);

private:
  /// An edge of a triangle, and the opposite vertex.
  struct Edge
  {
    std::array<std::int64_t, 2> Ids; ///< the lower first
    bool IsReversed;                 ///< the triangle goes from the higher to the lower
    std::array<check::Position, 2> Ends;
    check::Position Opposite;
    bool IsSound; ///< a counter-clockwise triangle
    std::int64_t Cell;
    std::int64_t Neighbor; ///< as stored with the triangle
  };

  void checkTriangles(const CheckedPiece& piece);
  void checkPoints(const CheckedPiece& piece);
  void checkEdges(const CheckedPiece& piece);
  void checkPair(const Edge& a, const Edge& b);
  bool isConstraint(const Edge& edge) const;
  void keepHull(const CheckedPiece& piece, const std::vector<std::int32_t>& points);
  void matchEdges();
  Edge edgeOf(const CheckedPiece& piece, std::size_t halfEdge) const;

  CheckOptions Options;
  CheckReport Report;
  std::vector<char> IsSound; ///< of the current piece's triangles
  std::vector<char> IsGood;  ///< its points exist
  std::vector<Edge> Open;    ///< edges without a second triangle so far
  const std::int64_t Given;
  std::int64_t GivenPoints = 0;
  std::uint64_t PointSum = 0;
  std::vector<double> HullXY; ///< with IsCut: points of each piece's own convex hull
  bool IsCollinear = true;
  std::vector<check::Position> Line; ///< two points, if all points so far lie on their line
};

/// Tells which edges of a large mesh may be parts of constraints, so that only these are kept. Too
/// many may be; too few would be reported as lost constraints.
class NearConstraints
{
public:
  /// xy: x and y of points; edges: two indices each.
  NearConstraints(
    const std::vector<double>& xy, const std::vector<std::array<std::int64_t, 2>>& edges);

  /// Whether both ends of an edge lie within about a million rounding errors of one constraint.
  bool mayHave(check::Position a, check::Position b) const;

private:
  struct Segment
  {
    check::Position A;
    check::Position B;
  };
  template <typename Visit>
  void visitCells(const Segment& segment, const Visit& visit) const;
  std::int64_t cellOf(double value, std::size_t axis) const;
  bool isNear(check::Position p, const Segment& segment) const;

  std::vector<Segment> Segments;
  std::array<double, 2> Low{};
  std::array<double, 2> High{};
  double Tolerance = 0;
  std::int64_t Side = 1;              ///< cells along each axis
  std::vector<std::size_t> Starts;    ///< of each cell's, and the end
  std::vector<std::uint32_t> InCells; ///< segments
};

} // namespace tipp

#endif
