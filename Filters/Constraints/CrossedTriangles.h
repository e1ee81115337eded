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

/// The triangles that constraints cross, and the vertices that they touch.
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

/// Finds the triangles that pieces cross, except pieces that were inserted already. Pieces and
/// triangles use the same vertex ids. `blocks` are interior triangles of partitions, by ascending
/// position: blocks with no piece near are skipped. `inserted` has what was found while the points
/// were triangulated.
template <typename Id>
CrossedTriangles findCrossedTriangles(PointsView points, const Id* corners, std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, int threads);

} // namespace tipp

#endif
