// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayKernel_h
#define tippDelaunayKernel_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/InsertionOrder.h"
#include "Predicates/CoordinateGrid.h"
#include "Predicates/Point2.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
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
  static constexpr Index Infinite = 0;

  struct Duplicate
  {
    std::uint32_t Point; ///< its place in the order of insert()
    Index Vertex;        ///< the vertex that stands for it
  };

  DelaunayKernel();

  void clear();
  void insert(const Point2* points, std::size_t count);

  /// False as long as all points are collinear: then there are no triangles.
  bool hasTriangles() const { return this->Mesh.end() > 0; }

  /// All triangles, those at the infinite vertex too.
  const HalfEdgeMesh& mesh() const { return this->Mesh; }
  bool isInfinite(Index triangle) const;
  Point2 point(Index vertex) const { return this->Points[vertex]; }

  /// The place of a vertex's point, counted over all points inserted since clear().
  std::uint32_t place(Index vertex) const { return this->Places[vertex]; }
  Index vertexEnd() const { return static_cast<Index>(this->Points.size()); }

  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }

private:
  /// A vertex as seen from the point p that is being inserted.
  struct Direction
  {
    double X;
    double Y;
    double lift() const { return this->X * this->X + this->Y * this->Y; }
  };
  /// The triangle that holds p, or an infinite one in conflict with it, as seen from p. Edge i goes
  /// from corner i to the next.
  struct Location
  {
    Index Triangle;
    Direction Corner[3];
    double Cross[3]; ///< of each edge's ends
    Index Outer[3];
  };
  /// Two edges side by side, (first, second) in every pair, counter-clockwise around p.
  using Pair = double __attribute__((vector_size(16)));
  struct EdgePair
  {
    Pair StartX; ///< from p
    Pair StartY;
    Pair StartLift;
    Pair StopX;
    Pair StopY;
    Pair StopLift;
    Pair Cross; ///< start x stop
    // The half-edges on their other sides; no array, which would keep all this out of registers.
    Index FirstOuter;
    Index SecondOuter;
  };
  /// The apexes of the triangles behind a pair.
  struct ApexPair
  {
    Pair X;
    Pair Y;
    Pair Lift;
    Pair StartCross; ///< start x apex
    Pair StopCross;
  };
  /// An edge around the cavity.
  struct RingEdge
  {
    Index Outer;
    Index Start;
  };
  /// What is left to do while the cavity grows: another pair, or an edge of the ring.
  struct Deferred
  {
    EdgePair Edges;
    bool IsPair;
  };

  bool makeFirstTriangle(Index firstVertex);
  void insertVertex(Index vertex);

  Direction directionTo(Index vertex, Point2 p) const;
  Location locate(Point2 p);
  Location seenFrom(Point2 p, Index triangle) const;
  Index equalVertex(const Location& location, Point2 p) const;
  void openCavity(const Location& location, Point2 p);
  unsigned testPair(const EdgePair& pair, Point2 p, ApexPair& apex);
  void fillCavity(Index vertex);
  bool isInConflict(Index triangle, Point2 p);
  bool isInConflictWithInfinite(Index infiniteSlot, Point2 p);
  int exactOrientation(Point2 a, Point2 b, Point2 c);
  const CoordinateGrid& grid();

  HalfEdgeMesh Mesh;
  std::vector<Point2> Points;
  std::vector<std::uint32_t> Places;
  std::vector<Duplicate> Duplicates;
  std::uint32_t PlaceEnd = 0;
  Index Pending = 1; ///< vertices from here on wait for a point off the line of all before
  Index Recent = 0;  ///< a triangle near the last insertion
  InsertionOrder Order;

  std::vector<Index> Cavity;
  std::vector<RingEdge> Ring;
  std::vector<Deferred> Stack;
  std::size_t CavitySize = 0;
  std::size_t RingSize = 0;

  CoordinateGrid Grid;
  bool GridIsCurrent = false;
  std::size_t TurnFailures = 0; ///< of the filter, since the batch began
};

} // namespace tipp

#endif
