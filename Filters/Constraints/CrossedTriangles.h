// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrossedTriangles_h
#define tippCrossedTriangles_h

#include "Constraints/Constraint.h"
#include "Triangulation/PointsView.h"

#include <cstdint>
#include <vector>

namespace tipp
{

class PartitionConstraints;

/// What constraints do to the triangles of a triangulation.
struct CrossedTriangles
{
  /// A vertex in the interior of a piece.
  struct Touch
  {
    std::int64_t Piece;
    PointId Vertex;
  };

  std::vector<std::int64_t> Triangles; ///< those whose interior a piece meets, ascending
  std::vector<std::int64_t> Starts;    ///< of each one's pieces; and the end
  std::vector<std::int64_t> Pieces;
  std::vector<Touch> Touches; ///< sorted by piece and vertex, each once
};

/// Finds them, but for pieces that were inserted already. Pieces and triangles name vertices by the
/// same ids. Blocks are boxes known to hold some of the triangles, by ascending position: where no
/// piece is near, these are not looked at. Inserted: what is known since the points were
/// triangulated.
template <typename Id>
CrossedTriangles findCrossedTriangles(PointsView points, const Id* corners, std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, int threads);

extern template CrossedTriangles findCrossedTriangles(PointsView, const std::int32_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, int);
extern template CrossedTriangles findCrossedTriangles(PointsView, const std::int64_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, int);

} // namespace tipp

#endif
