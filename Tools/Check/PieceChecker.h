// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceChecker_h
#define tippPieceChecker_h

#include "Check/DelaunayChecker.h"
#include "Check/ExactTests.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// One piece of a mesh, with the triangles that other pieces own but that have one of its points.
struct CheckedPiece
{
  std::vector<double> XY;              ///< of its points, those of other pieces too
  std::vector<std::int64_t> Ids;       ///< of the points in the whole mesh
  std::vector<bool> IsOwn;             ///< of the points: the piece's, or another's
  std::vector<std::int32_t> Triangles; ///< three numbers of points each
  std::int64_t OwnTriangles = 0;       ///< the first so many
  std::vector<std::int64_t> CellIds;   ///< of own triangles in the whole mesh
  std::vector<std::int64_t> Neighbors; ///< what these say: opposite each corner; empty: nothing
};

/// checkDelaunay() of a mesh that comes piece by piece: in memory are one piece and the edges
/// between pieces.
class PieceChecker
{
public:
  explicit PieceChecker(const CheckOptions& options)
    : Options(options)
  {
  }

  void add(const CheckedPiece& piece);
  /// After all pieces.
  CheckReport finish();

  /// Of the ids and places of all points that pieces own: equal sums are those of equal points, but
  /// for a chance of 2^-64.
  std::uint64_t pointSum() const { return this->PointSum; }
  static std::uint64_t hashPoint(std::int64_t id, double x, double y);

private:
  /// An edge of a triangle, and what lies off it.
  struct Edge
  {
    std::array<std::int64_t, 2> Ids; ///< the lower first
    bool IsReversed;                 ///< the triangle goes from the higher to the lower
    std::array<check::Position, 2> Ends;
    check::Position Opposite;
    bool IsSound; ///< a triangle that turns counter-clockwise
    std::int64_t Cell;
    std::int64_t Neighbor; ///< as the triangle says
  };

  void checkTriangles(const CheckedPiece& piece);
  void checkPoints(const CheckedPiece& piece);
  void checkEdges(const CheckedPiece& piece);
  void checkPair(const Edge& a, const Edge& b);
  void matchEdges();
  Edge edgeOf(const CheckedPiece& piece, std::size_t halfEdge) const;

  CheckOptions Options;
  CheckReport Report;
  std::vector<char> IsSound; ///< of the present piece's triangles
  std::vector<char> IsGood;  ///< its points exist
  std::vector<Edge> Open;    ///< edges without a second triangle so far
  std::uint64_t PointSum = 0;
  bool IsCollinear = true;
  std::vector<check::Position> Line; ///< two points, where all so far are on their line
};

} // namespace tipp

#endif
