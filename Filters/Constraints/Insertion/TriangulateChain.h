// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateChain_h
#define tippTriangulateChain_h

#include "Kernel/Lanes.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Points.h"

#include <cmath>

namespace tipp
{

/// The angle at which a vertex sees a segment.
//
// Its cotangent is the quotient of the dot product and the cross product of the vectors from the
// vertex to the segment's ends. Of two vertices on the same side, the one with the larger angle is
// inside the circle of the other one and the ends: the in-circle determinant is the difference of
// dot(one) cross(other) and dot(other) cross(one). This takes fewer operations than inCircle() if
// one vertex is compared with several others.
class ViewAngle
{
public:
  /// The vertex must be on the left of the segment.
  ViewAngle(Point2 from, Point2 to, Point2 vertex)
  {
    const Pair at{ vertex.x, vertex.y };
    const Pair u = Pair{ from.x, from.y } - at;
    const Pair w = Pair{ to.x, to.y } - at;
    const Pair first = Pair{ u[0], u[0] } * w;
    const Pair second = Pair{ u[1], u[1] } * Pair{ w[1], -w[0] };
    this->DotAndCross = first + second;
    // A product below the normal range loses at most 2^-1075. The constant keeps this below the
    // bound in isLarger().
    constexpr double tiny = 1e-300;
    this->Magnitudes = magnitude(first) + magnitude(second) + Pair{ tiny, tiny };
  }

  /// Whether this angle is larger than the other one. If doubles cannot tell, decide() does.
  template <typename Decide>
  bool isLarger(const ViewAngle& other, const Decide& decide) const
  {
    // Each dot and cross product has 4 roundings, their products 9, the difference 10. As the
    // magnitudes are rounded too, 10.8 e is used, e = 2^-53.
    constexpr double relative = 1.2e-15;
    constexpr double absolute = 1e-300;
    const Pair products = this->DotAndCross * swapped(other.DotAndCross);
    const Pair magnitudes = this->Magnitudes * swapped(other.Magnitudes);
    const double difference = products[1] - products[0];
    // After an overflow the bound is infinite or NaN, and the comparison is false.
    const double bound = relative * (magnitudes[0] + magnitudes[1]) + absolute;
    return std::fabs(difference) > bound ? difference > 0 : decide();
  }

  /// Becomes `other` if the condition is true. Without a branch, which would often be mispredicted.
  void replaceIf(bool condition, const ViewAngle& other)
  {
    this->DotAndCross = condition ? other.DotAndCross : this->DotAndCross;
    this->Magnitudes = condition ? other.Magnitudes : this->Magnitudes;
  }

private:
  static Pair swapped(Pair a) { return Pair{ a[1], a[0] }; }

  Pair DotAndCross;
  Pair Magnitudes; ///< sums of the magnitudes of the products in DotAndCross
};

/// Triangulates the area between a segment and a chain of vertices on one side of it, so that it is
/// Delaunay under the tie rule. The chain starts and ends at the segment's ends. Every vertex sees
/// the segment along a crossed edge, and these lines of sight do not meet.
///
/// The vertex whose circle with the segment's ends contains no other is the apex of the segment's
/// triangle, whose other sides take the segment's part for the two halves of the chain (Anglada
/// 1997). All vertices of a half are beyond its side, since their lines of sight cross it. A vertex
/// is in the chain twice if other vertices are between its lines of sight. These are in its
/// triangle with the segment's ends, so the vertex becomes an apex after them, when the chain has
/// been divided between its two occurrences. Takes quadratic time at worst.
///
/// A Vertex has an id Vertex, a Position, and Outer, which stands for the chain's edge before it.
/// make(first vertex, its side to the apex, apex, the apex's side to last, last vertex) makes a
/// triangle, whose corners are in the order of the chain, and returns what stands for the edge
/// between the first and the last vertex. Returns what stands for the segment.
template <bool isLeft, typename Vertex, typename MakeTriangle>
decltype(Vertex::Outer) triangulateChain(
  const Vertex* first, const Vertex* last, const MakeTriangle& make)
{
  const Point2 from = isLeft ? first->Position : last->Position;
  const Point2 to = isLeft ? last->Position : first->Position;
  switch (last - first)
  {
    case 1:
      return last->Outer;
    case 2:
      return make(first->Vertex, first[1].Outer, first[1].Vertex, last->Outer, last->Vertex);
    case 3:
    {
      // Without branches, which would be mispredicted half of the time. The apex is the second or
      // the first vertex; the other triangle is before or after it.
      const bool isSecond = inCirclePerturbed(from, to, first[1].Position, first[2].Position);
      const Vertex* const p = first + (isSecond ? 0 : 1);
      const auto other = make(p->Vertex, p[1].Outer, p[1].Vertex, p[2].Outer, p[2].Vertex);
      const auto before = isSecond ? other : first[1].Outer;
      const auto after = isSecond ? last->Outer : other;
      return make(first->Vertex, before, first[isSecond ? 2 : 1].Vertex, after, last->Vertex);
    }
    default:
      break;
  }
  const Vertex* apex = first + 1;
  ViewAngle largest(from, to, apex->Position);
  for (const Vertex* v = apex + 1; v != last; ++v)
  {
    const ViewAngle angle(from, to, v->Position);
    const bool isLarger = angle.isLarger(
      largest, [&] { return inCirclePerturbed(from, to, apex->Position, v->Position); });
    apex = isLarger ? v : apex;
    largest.replaceIf(isLarger, angle);
  }
  const auto before = triangulateChain<isLeft>(first, apex, make);
  const auto after = triangulateChain<isLeft>(apex, last, make);
  return make(first->Vertex, before, apex->Vertex, after, last->Vertex);
}

} // namespace tipp

#endif
