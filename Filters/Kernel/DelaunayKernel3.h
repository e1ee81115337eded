// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayKernel3_h
#define tippDelaunayKernel3_h

#include "Arrays/Buffer.h"
#include "Kernel/Cavity3.h"
#include "Kernel/InsertionOrder.h"
#include "Kernel/TetrahedronMesh.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Returns whether three points in space are collinear. Exact for all finite coordinates.
bool areCollinear(const Point3& a, const Point3& b, const Point3& c);

/// The Delaunay triangulation of points in space. Incremental insertion (Bowyer 1981, Watson 1981)
/// in biased randomised rounds, with a vertex at infinity and exact predicates. Ties are broken by
/// the points' lexicographic order, so the set of tetrahedra is unique, and no tetrahedron is flat.
/// An object can triangulate many point sets, one after the other.
class VTKTIPPFILTERS_EXPORT DelaunayKernel3
{
public:
  using Index = TetrahedronMesh::Index;
  static constexpr Index Infinite = 0; ///< the vertex at infinity

  /// A point that is not a vertex because another point has the same coordinates.
  struct Duplicate
  {
    std::uint32_t Point; ///< its index in the input of triangulate()
    Index Vertex;        ///< the vertex with the same coordinates
  };

  /// Called regularly with the number of points inserted so far. Returns false to stop the run.
  using Monitor = std::function<bool(std::size_t)>;

  /// Triangulates `count` finite points and replaces the previous triangulation; `points` are
  /// copied. `more`: about how many points add() will bring; memory for them is reserved. If
  /// products of five coordinate differences under- or overflow, the result is still exact, but
  /// slow: the filters fail then. `threads`: how many threads insert points (ParallelInsertion3);
  /// the set of tetrahedra does not depend on it. Returns false, without a triangulation, if
  /// `proceed` returned false. Throws std::length_error if there are more points than indices.
  bool triangulate(const Point3* points, std::size_t count, const Monitor& proceed = {},
    int threads = 1, std::size_t more = 0);

  /// Adds points to a triangulation of Dimension 3. Their indices follow those of the points so
  /// far. Throws std::length_error as triangulate().
  void add(const Point3* points, std::size_t count);

  /// The dimension of the points: -1 without points, 0 if all have the same coordinates, 1 if they
  /// are collinear, 2 if coplanar, else 3. Below 3 there are neither tetrahedra nor duplicates.
  int dimension() const { return this->Dimension; }

  /// @name Tetrahedra, including those at the infinite vertex
  /// A tetrahedron is an index that only these functions interpret. A vertex is its position in the
  /// order of insertion; pointIndex() gives its index in the input.
  ///@{
  /// Calls visit(tetrahedron) for each tetrahedron.
  template <typename Visit>
  void forEach(const Visit& visit) const
  {
    this->forEach(0, 1, visit);
  }
  /// Calls visit(tetrahedron) for those in part number `part` of `parts`, so that threads can share
  /// the work.
  template <typename Visit>
  void forEach(std::size_t part, std::size_t parts, const Visit& visit) const
  {
    const std::uint8_t* const marks = this->Mesh.marks();
    const std::size_t cells = this->Mesh.end() / 8;
    const auto end = Index(8 * (cells * (part + 1) / parts));
    for (auto t = Index(8 * (cells * part / parts)); t < end; t += 8)
    {
      if (marks[t / 8] == TetrahedronMesh::Live)
      {
        visit(t);
      }
    }
  }
  /// The four vertices, in an order whose orientation3() is positive. The infinite vertex comes
  /// first.
  std::array<Index, 4> corners(Index tetrahedron) const
  {
    const Index* const v = this->Mesh.slots() + tetrahedron;
    return { v[0], v[1], v[2], v[3] };
  }
  /// The tetrahedron across the facet opposite to corner i.
  Index neighbour(Index tetrahedron, Index i) const
  {
    return TetrahedronMesh::cellOf(this->Mesh.slots()[tetrahedron + i + 4]);
  }
  bool isInfinite(Index tetrahedron) const { return this->Mesh.slots()[tetrahedron] == Infinite; }
  /// The tetrahedron's number, below numberEnd(): for arrays.
  static std::size_t number(Index tetrahedron) { return tetrahedron / 8; }
  std::size_t numberEnd() const { return number(this->Mesh.end()); }
  ///@}

  const Point3& point(Index vertex) const { return this->Points[vertex]; }
  /// The input index of the vertex's point: the lowest one of points with the same coordinates.
  std::uint32_t pointIndex(Index vertex) const { return this->PointIndices[vertex]; }
  /// One past the last vertex. Duplicates below it have no tetrahedra.
  Index vertexEnd() const { return static_cast<Index>(this->Points.size()); }

  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }

  /// Frees the memory and the triangulation.
  void release();

  /// Bytes allocated for points and tetrahedra.
  std::size_t bytes() const;

private:
  void append(const Point3* points, std::size_t count);
  bool makeFirst();
  bool insertAll(const Monitor& proceed, int threads);
  bool insertRange(Index first, Index end, const Monitor& proceed);
  void takeCoincidences();

  TetrahedronMesh Mesh;
  Uninitialised<Point3> Points;              ///< by vertex, in the order of insertion
  Uninitialised<std::uint32_t> PointIndices; ///< by vertex
  std::vector<Duplicate> Duplicates;
  std::vector<Cavity3::Coincidence> Coincidences;
  InsertionOrder3 Order;
  Cavity3 Opened;
  int Dimension = -1;
};

} // namespace tipp

#endif
