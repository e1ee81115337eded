// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBlockRefiner_h
#define tippBlockRefiner_h

#include "Predicates/ExactPredicates.h"
#include "Refinement/RefinementMesh.h"
#include "Refinement/RefinementQueue.h"
#include "Refinement/RefinementRules.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Refines the triangles of one block, a box, in one thread, while other threads do so in others.
///
/// A block owns the triangles whose corners are all in it, and only changes these. A triangle
/// beside an owned one shares two corners with it, so it is owned too, or by no block: no thread
/// changes what another one reads. If a cavity needs a triangle that is not owned, the element that
/// wants it waits for a round with other blocks. So the result depends on the blocks alone.
class BlockRefiner
{
public:
  using Index = RefinementMesh::Index;
  using Link = RefinementMesh::Link;
  using Triangle = RefinementMesh::Triangle;
  using Element = RefinementQueue::Element;

  struct Counts
  {
    std::int64_t Inserted = 0;
    std::int64_t Splits = 0;  ///< subsegments split
    std::int64_t GivenUp = 0; ///< triangles
  };

  BlockRefiner(RefinementMesh& mesh, const RefinementRules& rules)
    : Mesh(mesh)
    , Rules(rules)
  {
    this->enlarge();
  }

  /// What a run leaves.
  struct Result
  {
    std::vector<Element> Waiting; ///< they need another block
    ///@{
    /// The groups of places that it has taken.
    std::vector<Index> TriangleGroups;
    std::vector<Index> PointGroups;
    ///@}
  };

  /// Refines the elements that need it, and what comes of them, until none is left but those that
  /// must wait. Inserts at most `most` points in all runs; 0: no limit. `proceed`
  /// is called now and then and returns false to stop.
  template <typename Proceed>
  Result run(const Box2& block, const Element* begin, const Element* end, std::int64_t most,
    const Proceed& proceed);

  const Counts& counts() const { return this->Counted; }

private:
  enum class Outcome
  {
    Done,
    Waits, ///< it needs a triangle that the block does not own
    Impossible
  };
  /// A vertex as seen from the point to insert.
  struct SeenVertex
  {
    double X; ///< less that of the point
    double Y;
    double Square; ///< of the distance
    Index Vertex;
  };
  /// An edge of the cavity, directed with its triangle there on the left. While the cavity grows,
  /// most of the terms of the in-circle determinant are those of the edge before.
  struct Edge
  {
    double
      Cross; ///< of start and stop: twice the area of the triangle that the point makes with it
    std::int32_t Start; ///< index in Seen
    std::int32_t Stop;
    Link Inner; ///< the triangle of the cavity and its opposite corner
    Link Outer; ///< what is across
  };

  Triangle& at(Index t) { return this->Mesh.Triangles[std::size_t(t)]; }
  Point2 pointOf(Index vertex) const { return this->Mesh.Points[std::size_t(vertex)]; }
  bool owns(Point2 p) const
  {
    return p.x >= this->Block.Min.x && p.x < this->Block.Max.x && p.y >= this->Block.Min.y &&
      p.y < this->Block.Max.y;
  }
  bool owns(const std::array<Point2, 3>& p) const
  {
    return this->owns(p[0]) && this->owns(p[1]) && this->owns(p[2]);
  }
  static double crossOf(const SeenVertex& a, const SeenVertex& b) { return a.X * b.Y - a.Y * b.X; }

  void enqueue(Index t);
  void enqueue(Index t, const RefinementRules::Verdict& verdict)
  {
    if (verdict.Why != RefinementRules::Need::None)
    {
      this->Queue.add({ t, this->at(t).Version }, verdict);
    }
  }
  Outcome improve(Index t, RefinementRules::Need need);
  Outcome insertFor(Index t, Point2 p);
  Outcome splitEncroached(Index t);
  Outcome splitInWay(Index t);
  Outcome split(Index t, int corner);
  Point2 splitPoint(Index a, Index b, const InputSegment& segment) const;
  Outcome growAtSegment(Index t, int corner, Point2 p);

  bool isLeftOf(const Edge& edge, Point2 p) const;
  static bool isInConflict(const SeenVertex& start, const SeenVertex& stop, double cross,
    const SeenVertex& apex, double startCross, double crossStop, Point2 p, const Point2* points);
  void enlarge();
  void add(Index t);
  std::int32_t see(Index vertex, Point2 p);
  static void set(
    Edge& edge, double cross, std::int32_t start, std::int32_t stop, Link inner, Link outer)
  {
    edge.Cross = cross;
    edge.Start = start;
    edge.Stop = stop;
    edge.Inner = inner;
    edge.Outer = outer;
  }
  void push(Index t, int corner, std::int32_t start, std::int32_t stop);
  Outcome grow(Point2 p);
  void closeAgain();
  void clearCavity()
  {
    this->CavityEnd = 0;
    this->RimEnd = 0;
    this->StackEnd = 0;
    this->SeenEnd = 0;
  }
  void insert(Point2 p, Index origin);
  void markSpokes(std::size_t count);
  void enqueueMade(std::size_t count);

  RefinementMesh& Mesh;
  const RefinementRules& Rules;
  Box2 Block;
  RefinementQueue Queue;
  ArrayPlaces TrianglePlaces;
  ArrayPlaces PointPlaces;
  Counts Counted;
  // Of the current cavity, kept for their memory. All have room for a few elements more than
  // the cavity has triangles, which is enough: see add(). The ends are counts of elements.
  std::vector<Index> Cavity;    ///< triangles; while a point is inserted, those that replace them
  std::vector<Edge> Rim;        ///< of the cavity, counter-clockwise
  std::vector<Edge> Stack;      ///< edges to grow across; the last one is next
  std::vector<SeenVertex> Seen; ///< vertices of the cavity
  std::size_t CavityEnd = 0;
  std::size_t RimEnd = 0;
  std::size_t StackEnd = 0;
  std::size_t SeenEnd = 0;
  std::array<std::uint32_t, 2> Regions; ///< of the cavity's sides of the subsegment, as in State
  std::size_t SecondSide = 0;           ///< index in Regions of the edges of Rim from FirstFan on
  std::size_t FirstFan = 0; ///< number of edges of Rim on the one side of the subsegment to split
  std::vector<Edge> InWay;  ///< subsegments
};

template <typename Proceed>
BlockRefiner::Result BlockRefiner::run(const Box2& block, const Element* begin, const Element* end,
  std::int64_t most, const Proceed& proceed)
{
  this->Block = block;
  Result result;
  for (const Element* element = begin; element != end; ++element)
  {
    if (this->Mesh.isLive(element->Triangle, element->Version))
    {
      this->enqueue(element->Triangle);
    }
  }
  Element element;
  RefinementRules::Need need;
  for (std::uint32_t steps = 0; this->Queue.take(element, need); ++steps)
  {
    constexpr std::uint32_t often = 0x3ff;
    if (((steps & often) == 0 && !proceed()) || (most > 0 && this->Counted.Inserted >= most))
    {
      this->Queue.clear();
      break;
    }
    if (const Element* next = this->Queue.next())
    {
      __builtin_prefetch(&this->at(next->Triangle));
    }
    if (this->Mesh.isLive(element.Triangle, element.Version) &&
      this->improve(element.Triangle, need) == Outcome::Waits)
    {
      result.Waiting.push_back(element);
    }
  }
  const auto isGone = [this](const Element& waits)
  { return !this->Mesh.isLive(waits.Triangle, waits.Version); };
  result.Waiting.erase(
    std::remove_if(result.Waiting.begin(), result.Waiting.end(), isGone), result.Waiting.end());
  result.TriangleGroups = this->TrianglePlaces.finish();
  result.PointGroups = this->PointPlaces.finish();
  return result;
}

} // namespace tipp

#endif
