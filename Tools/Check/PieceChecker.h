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

/// One piece of a mesh, with all triangles at its points. Some of these are owned by other pieces.
struct CheckedPiece
{
  std::vector<double> XY;              ///< x and y of its points, including ghost points
  std::vector<std::int64_t> Ids;       ///< global ids of the points
  std::vector<bool> IsOwn;             ///< by point: whether the piece owns it
  std::vector<std::int32_t> Triangles; ///< three indices of the piece's points each
  std::int64_t OwnTriangles = 0;       ///< they come first in Triangles
  std::vector<std::int64_t> CellIds;   ///< global ids of the own triangles
  /// For each corner of an own triangle, the global id of the neighbour opposite to it, or -1.
  /// Empty if the mesh does not store them.
  std::vector<std::int64_t> Neighbors;
};

/// Does the same as checkDelaunay() for a mesh that is added piece by piece. Only one piece and the
/// edges between pieces are in memory.
class PieceChecker
{
public:
  /// `given`: points with this id and higher ids are not input points, and are left out of
  /// pointSum() and givenPoints().
  explicit PieceChecker(
    const CheckOptions& options, std::int64_t given = std::numeric_limits<std::int64_t>::max())
    : Options(options)
    , Given(given)
  {
  }

  /// Checks a piece.
  void add(const CheckedPiece& piece);
  /// Returns the result; call it after all pieces.
  CheckReport finish();

  /// A hash of the ids and coordinates of the owned input points. Equal sums mean equal points,
  /// except with a probability of 2^-64.
  std::uint64_t pointSum() const { return this->PointSum; }
  /// The number of owned input points.
  std::int64_t givenPoints() const { return this->GivenPoints; }
  static std::uint64_t hashPoint(std::int64_t id, double x, double y);

private:
  /// An edge of a triangle, and the vertex opposite to it.
  struct Edge
  {
    std::array<std::int64_t, 2> Ids; ///< global point ids, the lower first
    bool IsReversed;                 ///< in the triangle it goes from the higher id to the lower
    std::array<check::Position, 2> Ends;
    check::Position Opposite;
    bool IsSound; ///< the triangle is counter-clockwise
    /// Global id of the triangle; -1 if no neighbours are stored.
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
  std::vector<char> IsSound; ///< by triangle of the current piece: counter-clockwise
  std::vector<char> IsGood;  ///< by triangle: its points exist and are finite
  std::vector<Edge> Open;    ///< edges of which only one triangle has been found so far
  const std::int64_t Given;
  std::int64_t GivenPoints = 0;
  std::uint64_t PointSum = 0;
  std::vector<double> HullXY; ///< with IsCut: the points of the pieces' convex hulls
  bool IsCollinear = true;
  /// Up to two points; if IsCollinear, all points so far are on their line.
  std::vector<check::Position> Line;
};

/// Finds the edges of a large mesh that may be parts of constraints, so that only these are kept in
/// memory. It may keep too many edges, but must not miss one, which would be reported as a lost
/// constraint.
class NearConstraints
{
public:
  /// `xy`: x and y of each point. `edges`: two indices of points each. Both are copied.
  NearConstraints(
    const std::vector<double>& xy, const std::vector<std::array<std::int64_t, 2>>& edges);

  /// Returns whether both ends of an edge are within about a million rounding errors of one
  /// constraint.
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
  std::int64_t Side = 1; ///< cells of the grid along each axis
  /// By cell: the start of its entries in InCells; one more entry at the end.
  std::vector<std::size_t> Starts;
  std::vector<std::uint32_t> InCells; ///< indices of Segments, cell by cell
};

} // namespace tipp

#endif
