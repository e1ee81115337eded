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

/// One box's Delaunay triangulation: incremental insertion (Bowyer 1981, Watson 1981) in biased
/// randomised rounds, with a vertex at infinity, exact predicates, and ties broken by the points'
/// lexicographic order (Lemma 4). Single-threaded; meant to be used again for many boxes.
///
/// Points come in batches. A batch's triangles that no later batch destroys keep their places, so
/// that their order does not depend on the later batches.
class VTKTIPPFILTERS_EXPORT DelaunayKernel
{
public:
  using Index = HalfEdgeMesh::Index;
  static constexpr Index Infinite = InfiniteVertex;

  struct Duplicate
  {
    std::uint32_t Point; ///< its place in the order of insert()
    Index Vertex;        ///< the vertex that stands for it
  };

  explicit DelaunayKernel(Instructions instructions = Instructions::Best);
  DelaunayKernel(const DelaunayKernel&) = delete;
  DelaunayKernel& operator=(const DelaunayKernel&) = delete;

  void clear();

  /// Room for so many points in all, so that inserting them moves nothing. Memory that is not used
  /// is none of the system's.
  void reserve(std::size_t points);

  /// Gives the triangles' memory back. Vertices stay; but only clear() may follow.
  void releaseTriangles() { this->Mesh.release(); }

  /// The memory that its points and triangles take, most of what it keeps.
  std::size_t bytes() const;

  /// Asked now and then with the number of points inserted so far; false ends the insertion.
  using Monitor = std::function<bool(std::size_t)>;

  /// False if the monitor ended it: then only clear() makes sense.
  bool insert(const Point2* points, std::size_t count, const Monitor& proceed = {});

  /// False as long as all points are collinear: then there are no triangles.
  bool hasTriangles() const { return this->Mesh.end() > 0; }

  /// All triangles, those at the infinite vertex too.
  const HalfEdgeMesh& mesh() const { return this->Mesh; }
  /// After a change only clear() may follow.
  HalfEdgeMesh& meshToEdit() { return this->Mesh; }
  bool isInfinite(Index triangle) const
  {
    const Index* v = this->Mesh.slots() + triangle;
    return v[0] == Infinite || v[1] == Infinite || v[2] == Infinite;
  }
  Point2 point(Index vertex) const { return this->Points[vertex]; }

  /// The place of a vertex's point, counted over all points inserted since clear().
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
  Index Pending = 1; ///< vertices from here on wait for a point off the line of all before
  Index Recent = 0;  ///< a finite triangle near the last insertion
  InsertionOrder Order;
  KernelPredicates Predicates;
  Cavity Opened;
  std::vector<InsertionScene::Coincidence> Coincidences; ///< of the vertices inserted last
  const InsertVertices Insertion;
};

} // namespace tipp

#endif
