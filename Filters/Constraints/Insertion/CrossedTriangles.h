// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrossedTriangles_h
#define tippCrossedTriangles_h

#include "Constraints/Constraint.h"
#include "Triangulation/PointsView.h"

#include <cstdint>
#include <tuple>
#include <vector>

namespace tipp
{

class PartitionConstraints;

/// The triangles that pieces of constraints cross, and the vertices on pieces.
struct CrossedTriangles
{
  /// A triangle whose interior a piece meets.
  struct Crossing
  {
    std::int64_t Triangle;
    std::int64_t Piece;

    bool operator<(const Crossing& other) const
    {
      return std::tie(this->Triangle, this->Piece) < std::tie(other.Triangle, other.Piece);
    }
    bool operator==(const Crossing& other) const
    {
      return this->Triangle == other.Triangle && this->Piece == other.Piece;
    }
  };
  /// A vertex in the interior of a piece.
  struct Touch
  {
    std::int64_t Piece;
    PointId Vertex;

    bool operator<(const Touch& other) const
    {
      return std::tie(this->Piece, this->Vertex) < std::tie(other.Piece, other.Vertex);
    }
    bool operator==(const Touch& other) const
    {
      return this->Piece == other.Piece && this->Vertex == other.Vertex;
    }
  };

  std::vector<std::int64_t> Triangles; ///< crossed triangles, ascending
  std::vector<std::int64_t> Starts;    ///< start of each triangle's range in Pieces, and the end
  std::vector<std::int64_t> Pieces;
  std::vector<Touch> Touches; ///< sorted by piece and vertex, without repetition
};

/// Finds the triangles that pieces cross, except for pieces that have been inserted already. Pieces
/// and corners use the same vertex ids. `blocks` are ranges of interior triangles of partitions,
/// ascending; `inserted` has their crossings, and `remaining` are its remaining pieces. The other
/// triangles are searched.
template <typename Id>
CrossedTriangles findCrossedTriangles(PointsView points, const Id* corners, std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, const std::vector<std::int64_t>& remaining, int threads);

} // namespace tipp

#endif
