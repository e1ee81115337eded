// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayKernel_h
#define tippDelaunayKernel_h

#include "Kernel/Cavity.h"
#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/Insertion.h"
#include "Kernel/InsertionOrder.h"
#include "Kernel/KernelPredicates.h"
#include "Kernel/Uninitialised.h"
#include "Predicates/Point2.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// The Delaunay triangulation of one box: incremental insertion (Bowyer 1981, Watson 1981) in
/// biased randomised rounds, with a vertex at infinity, exact predicates, and ties broken by the
/// points' lexicographic order (Lemma 4). Single-threaded; reusable for many boxes.
///
/// Points are inserted in batches. Triangles of a batch that no later batch destroys keep their
/// indices, so their order does not depend on the later batches.
class VTKTIPPFILTERS_EXPORT DelaunayKernel
{
public:
  using Index = HalfEdgeMesh::Index;
  static constexpr Index Infinite = InfiniteVertex;

  /// A point that is not a vertex, because another one has its coordinates.
  struct Duplicate
  {
    std::uint32_t Point; ///< its index, counted over all insert() calls since clear()
    Index Vertex;        ///< the vertex with the same coordinates
  };

  explicit DelaunayKernel(Instructions instructions = Instructions::Best);
  DelaunayKernel(const DelaunayKernel&) = delete;
  DelaunayKernel& operator=(const DelaunayKernel&) = delete;

  /// Removes all points and triangles; keeps the memory.
  void clear();

  /// Reserves memory for `points` points in total, so that inserting them reallocates nothing.
  /// Untouched pages are not committed.
  void reserve(std::size_t points);

  /// Frees the triangles' memory. Vertices stay; only clear() may be called next.
  void releaseTriangles() { this->Mesh.release(); }

  /// Bytes allocated for points and triangles, most of what the kernel holds.
  std::size_t bytes() const;

  /// Called now and then with the number of points inserted so far; returning false ends the
  /// insertion.
  using Monitor = std::function<bool(std::size_t)>;

  /// Inserts `count` points. Returns false if `proceed` returned false; only clear() may be called
  /// then.
  bool insert(const Point2* points, std::size_t count, const Monitor& proceed = {});

  /// False while all inserted points are collinear: there are no triangles yet.
  bool hasTriangles() const { return this->Mesh.end() > 0; }

  /// All triangles, including those at the infinite vertex.
  const HalfEdgeMesh& mesh() const { return this->Mesh; }
  /// After a change only clear() may follow.
  HalfEdgeMesh& meshToEdit() { return this->Mesh; }
  bool isInfinite(Index triangle) const
  {
    const Index* v = this->Mesh.slots() + triangle;
    return v[0] == Infinite || v[1] == Infinite || v[2] == Infinite;
  }
  Point2 point(Index vertex) const { return this->Points[vertex]; }

  /// The index of the vertex's point, counted over all points inserted since clear().
  std::uint32_t place(Index vertex) const { return this->Places[vertex]; }
  Index vertexEnd() const { return static_cast<Index>(this->Points.size()); }

  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }

private:
  bool makeFirstTriangle(Index firstVertex);
  void insertVertices(Index first, Index end);

  HalfEdgeMesh Mesh;
  Uninitialised<Point2> Points;
  Uninitialised<std::uint32_t> Places;
  std::vector<Duplicate> Duplicates;
  std::uint32_t PlaceEnd = 0;
  Index Pending = 1; ///< first vertex not inserted yet: all points before it are collinear
  Index Recent = 0;  ///< a finite triangle near the last insertion
  InsertionOrder Order;
  KernelPredicates Predicates;
  Cavity Opened;
  std::vector<InsertionScene::Coincidence> Coincidences; ///< of the vertices inserted last
  const InsertVertices Insertion;
};

} // namespace tipp

#endif
