// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrossedTriangles_h
#define tippCrossedTriangles_h

#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <tuple>
#include <vector>

namespace tipp
{

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

} // namespace tipp

#endif
