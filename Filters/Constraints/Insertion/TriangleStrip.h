// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleStrip_h
#define tippTriangleStrip_h

#include "Constraints/Constraint.h"
#include "Constraints/Insertion/TriangulateChain.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Points.h"
#include "Triangulation/Triangulate.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace tipp
{

/// A triangle of points, counter-clockwise.
struct LocatedTriangle
{
  std::array<PointId, 3> Ids;
  std::array<Point2, 3> Positions;
};

/// Retriangulates the triangles that one segment crosses, if they are few. It needs no mesh,
/// because it searches all triangles for each neighbour.
class TriangleStrip
{
public:
  /// Each step searches all triangles. ConstraintRegion takes any number.
  static constexpr std::size_t MostTriangles = 32;

  /// Follows the segment from point a to point b. `triangles` are those that it crosses, in any
  /// order. Throws CrossingFound if it crosses an edge for which isConstraint(ids of its ends) is
  /// true.
  template <typename IsConstraint>
  void follow(const LocatedTriangle* triangles, std::size_t count, PointId a, PointId b,
    const IsConstraint& isConstraint)
  {
    const Corner start =
      find(triangles, count, [a](const Ids& ids, std::size_t i) { return ids[i] == a; });
    const Corner end =
      find(triangles, count, [b](const Ids& ids, std::size_t i) { return ids[i] == b; });
    const Point2 from = start.vertex(0).Position;
    const Point2 to = end.vertex(0).Position;
    this->Left.assign({ start.vertex(0), start.vertex(2) });
    this->Right.assign({ start.vertex(0), start.vertex(1) });
    for (std::size_t crossed = 1; crossed < count; ++crossed)
    {
      const PointId left = this->Left.back().Vertex;
      const PointId right = this->Right.back().Vertex;
      if (isConstraint(left, right))
      {
        throw CrossingFound();
      }
      const Corner next = find(triangles, count,
        [left, right](const Ids& ids, std::size_t i)
        { return ids[i] == left && ids[(i + 1) % 3] == right; });
      const ChainVertex apex = next.vertex(2);
      const int side = apex.Vertex == b ? 0 : orientation(from, to, apex.Position);
      side >= 0 ? this->Left.push_back(apex) : void();
      side <= 0 ? this->Right.push_back(apex) : void();
    }
    if (this->Left.back().Vertex != b || this->Right.back().Vertex != b)
    {
      throw std::logic_error("A constraint does not follow the triangles that it crosses.");
    }
  }

  /// Calls visit(ids) for each triangle of the constrained Delaunay triangulation of the strip's
  /// vertices with the segment: as many triangles as before, counter-clockwise.
  template <typename Visit>
  void triangulate(const Visit& visit) const
  {
    triangulateChain<true>(&this->Left.front(), &this->Left.back(),
      [&](PointId first, Edge, PointId apex, Edge, PointId last)
      {
        visit(Ids{ first, last, apex });
        return Edge();
      });
    triangulateChain<false>(&this->Right.front(), &this->Right.back(),
      [&](PointId first, Edge, PointId apex, Edge, PointId last)
      {
        visit(Ids{ first, apex, last });
        return Edge();
      });
  }

private:
  using Ids = std::array<PointId, 3>;
  struct Edge
  {
  };
  struct ChainVertex
  {
    PointId Vertex;
    Point2 Position;
    Edge Outer; ///< nothing has to be known about edges
  };
  struct Corner
  {
    const LocatedTriangle& Triangle;
    std::size_t First;

    /// The vertex after `steps` counter-clockwise.
    ChainVertex vertex(std::size_t steps) const
    {
      const std::size_t i = (this->First + steps) % 3;
      return { this->Triangle.Ids[i], this->Triangle.Positions[i], {} };
    }
  };

  template <typename IsWanted>
  static Corner find(const LocatedTriangle* triangles, std::size_t count, const IsWanted& isWanted)
  {
    for (const LocatedTriangle* t = triangles; t != triangles + count; ++t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        if (isWanted(t->Ids, i))
        {
          return { *t, i };
        }
      }
    }
    throw std::logic_error("A constraint crosses a triangle that is not known.");
  }

  std::vector<ChainVertex> Left;
  std::vector<ChainVertex> Right;
};

} // namespace tipp

#endif
