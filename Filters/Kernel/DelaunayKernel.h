// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayKernel_h
#define tippDelaunayKernel_h

#include "Arrays/Buffer.h"
#include "Kernel/Cavity.h"
#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/InsertionOrder.h"
#include "Kernel/KernelPredicates.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
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

  /// Bytes allocated for points and triangles, which is most of the kernel's memory.
  std::size_t bytes() const;

  /// Called now and then with the number of points inserted so far; returning false ends the
  /// insertion.
  using Monitor = std::function<bool(std::size_t)>;

  /// Inserts `count` points. Returns false if `proceed` returned false; only clear() may be called
  /// then.
  bool insert(const Point2* points, std::size_t count, const Monitor& proceed = {});

  /// Points to insert into a kernel.
  struct Batch
  {
    DelaunayKernel& Kernel;
    const Point2* Points;
    std::size_t Count;
  };

  /// Inserts points into two kernels, a step here and a step there: the processor computes one step
  /// while the other's branch waits for its comparisons. The meshes are as after two calls of
  /// insert(), which take a tenth longer.
  static void insertTwo(const Batch& one, const Batch& other);

  /// False while all inserted points are collinear: there are no triangles yet.
  bool hasTriangles() const { return this->Mesh.end() > 0; }

  /// @name Triangles, including those at the infinite vertex
  /// A triangle is an index that only these functions interpret.
  ///@{
  /// The triangle's number, in the mesh's order: for arrays of triangleCount() entries.
  static std::size_t number(Index triangle) { return std::size_t(triangle / 8); }
  static Index triangle(std::size_t number) { return static_cast<Index>(8 * number); }
  std::size_t triangleCount() const { return number(this->Mesh.end()); }
  /// Calls visit(triangle) for all triangles, by ascending number.
  template <typename Visit>
  void forEach(const Visit& visit) const
  {
    this->forEach(0, 1, visit);
  }
  /// Calls visit(triangle) for those in part number `part` of `parts`, so that threads can share
  /// the work.
  template <typename Visit>
  void forEach(std::size_t part, std::size_t parts, const Visit& visit) const
  {
    const std::size_t count = this->triangleCount();
    const Index end = triangle(count * (part + 1) / parts);
    for (Index t = triangle(count * part / parts); t < end; t += 8)
    {
      visit(t);
    }
  }
  /// The vertices, counter-clockwise.
  std::array<Index, 3> corners(Index triangle) const
  {
    const Index* const v = this->Mesh.slots() + triangle;
    return { v[0], v[1], v[2] };
  }
  /// The triangle across the edge opposite to corner i.
  Index neighbour(Index triangle, Index i) const
  {
    return HalfEdgeMesh::triangleOf(this->Mesh.twin(triangle + i));
  }
  bool isInfinite(Index triangle) const
  {
    const Index* v = this->Mesh.slots() + triangle;
    return v[0] == Infinite || v[1] == Infinite || v[2] == Infinite;
  }
  ///@}

  Point2 point(Index vertex) const { return this->Points[vertex]; }
  /// The index of the vertex's point, counted over all points inserted since clear().
  std::uint32_t pointIndex(Index vertex) const { return this->PointIndices[vertex]; }
  Index vertexEnd() const { return static_cast<Index>(this->Points.size()); }

  /// The data structure, for the kernel's own parts.
  const HalfEdgeMesh& mesh() const { return this->Mesh; }
  /// The same, to be modified. After a change only corners() and clear() may follow.
  HalfEdgeMesh& editMesh() { return this->Mesh; }
  /// The vertices' positions, the infinite one first.
  const Point2* points() const { return this->Points.data(); }

  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }

private:
  class Insertion;

  bool addVertices(const Point2* points, std::size_t count);
  bool makeFirstTriangle(Index firstVertex);
  /// Inserts the pending vertices before `end` in order. The mesh has triangles, and capacity for
  /// two more for each vertex.
  void insertUpTo(Index end);
  void insertInOrder(Index end);
  static void insertInTurn(DelaunayKernel& one, DelaunayKernel& other);
  void addDuplicate(Index vertex, Index equal);

  HalfEdgeMesh Mesh;
  Uninitialised<Point2> Points;
  Uninitialised<std::uint32_t> PointIndices; ///< by vertex: the index of its point
  std::vector<Duplicate> Duplicates;
  std::uint32_t PointEnd = 0; ///< points inserted since clear()
  Index Pending = 1;          ///< first vertex not inserted yet: all points before it are collinear
  Index Recent = 0;           ///< a finite triangle near the last insertion
  InsertionOrder Order;
  KernelPredicates Predicates;
  Cavity Opened;
  const Instructions Allowed;
};

/// A kernel that takes its memory from a pool and returns it there on destruction; the pool keeps
/// up to 16 MiB in the whole process. For 10,000 points the first touch of fresh memory would take
/// a fifth of the time.
class VTKTIPPFILTERS_EXPORT PooledKernel
{
public:
  PooledKernel();
  ~PooledKernel();

  DelaunayKernel& operator*() { return *this->Kernel; }

  static constexpr std::size_t MostBytesKept = std::size_t(16) << 20;
  static std::size_t bytesKept();

private:
  std::unique_ptr<DelaunayKernel> Kernel;
};

} // namespace tipp

#endif
