// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshEdges_h
#define tippMeshEdges_h

#include "Check/ExactTests.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{
namespace check
{

/// The edges of triangles, with their triangles on both sides.
class MeshEdges
{
public:
  static constexpr std::int64_t None = -1;

  /// `xy`: x and y of each point; it must outlive this object. `triangles`: three indices of points
  /// each; those with an index that does not exist, or of a point that is not finite, are left out.
  /// Takes up about 30 bytes a triangle. Throws std::length_error for 2^32 points.
  MeshEdges(const std::vector<double>& xy, const std::vector<std::int64_t>& triangles);

  Position at(std::int64_t point) const
  {
    return { this->XY[2 * std::size_t(point)], this->XY[2 * std::size_t(point) + 1] };
  }

  /// Returns the vertex at a position, or None. If the input has several points there, only one of
  /// them is a vertex.
  std::int64_t vertexAt(Position p) const;

  /// Calls visit(neighbour) for each vertex at the other end of an edge.
  template <typename Visit>
  void visitNeighbors(std::int64_t vertex, const Visit& visit) const
  {
    for (const Edge& edge : this->edgesFrom(vertex))
    {
      visit(std::int64_t(edge.To));
    }
  }

  /// Returns whether an edge must be on a constraint: it is not locally Delaunay, with `tieRule`
  /// breaks a tie against the rule, or with `isCut` has one triangle only.
  bool needsConstraint(std::int64_t a, std::int64_t b, bool tieRule, bool isCut) const;

  /// Returns whether test(a, b), of two vertices, is true for all edges, or until it is not.
  template <typename Test>
  bool allEdges(const Test& test) const
  {
    for (std::int64_t from = 0; from < this->points(); ++from)
    {
      for (const Edge& edge : this->edgesFrom(from))
      {
        if (!test(from, std::int64_t(edge.To)))
        {
          return false;
        }
      }
    }
    return true;
  }

  /// Calls visit(from, to) for each edge that has one triangle only, which is on its left.
  template <typename Visit>
  void visitBorder(const Visit& visit) const
  {
    for (std::int64_t from = 0; from < this->points(); ++from)
    {
      for (const Edge& edge : this->edgesFrom(from))
      {
        if (edge.Left == NoIndex)
        {
          visit(std::int64_t(edge.To), from);
        }
      }
    }
  }

  /// Returns the third corner of the triangle on the left of an edge; None: there is none.
  std::int64_t leftOf(std::int64_t from, std::int64_t to) const;

  /// Returns the vertices of edges that have one triangle only, sorted by position.
  std::vector<std::int64_t> borderVertices() const;

  /// Returns whether the way from a vertex to a position begins inside of a triangle, or along an
  /// edge.
  bool entersMesh(std::int64_t vertex, Position to) const;

private:
  using Index = std::uint32_t;
  static constexpr Index NoIndex = ~Index(0);
  struct Edge
  {
    Index To;
    Index Left; ///< the third corner of the triangle on the left; NoIndex: there is none
  };
  struct EdgeRange
  {
    const Edge* First;
    const Edge* Last;
    const Edge* begin() const { return this->First; }
    const Edge* end() const { return this->Last; }
  };

  std::int64_t points() const { return std::int64_t(this->XY.size() / 2); }
  EdgeRange edgesFrom(std::int64_t vertex) const
  {
    const Edge* const first = this->Edges.data();
    return { first + this->Starts[std::size_t(vertex)],
      first + this->Starts[std::size_t(vertex) + 1] };
  }
  const Edge* find(std::int64_t from, std::int64_t to) const;
  void addTriangles(const std::vector<std::int64_t>& triangles);
  void sortEdges();
  void addBorder();
  static std::int64_t idOf(Index index) { return index == NoIndex ? None : std::int64_t(index); }
  bool isBeforeAt(std::int64_t a, std::int64_t b) const
  {
    return isBefore(this->at(a), this->at(b));
  }

  const std::vector<double>& XY;
  std::vector<Edge> Edges;         ///< both directions of each edge, sorted by start and end
  std::vector<std::size_t> Starts; ///< by point, and one more: its edges' index in Edges
  std::vector<Index> Vertices;     ///< sorted by position
};

} // namespace check
} // namespace tipp

#endif
