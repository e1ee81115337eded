// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSegmentInserter_h
#define tippSegmentInserter_h

#include "Constraints/Insertion/ConstrainedMesh.h"
#include "Kernel/Pairs.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

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

/// Inserts segments one by one into a constrained Delaunay triangulation.
///
/// A segment replaces the triangles that it crosses. The vertices of these triangles form a chain
/// on each side of the segment, from one end to the other. A short chain is triangulated by
/// triangulateChain(), which takes quadratic time at worst. Long chains are triangulated by ear
/// clipping: every vertex sees the segment along a crossed edge, and these lines of sight do not
/// meet, so three consecutive vertices that turn away from the segment enclose no other. Then edges
/// are flipped until all are locally Delaunay, as in CGAL's triangulation.
class SegmentInserter
{
public:
  using Index = ConstrainedMesh::Index;

  /// Inserts segments into this mesh, which must outlive this object.
  explicit SegmentInserter(ConstrainedMesh& mesh)
    : Mesh(mesh)
  {
  }

  /// Inserts the segment between the first and the last vertex of the chains, which crosses no
  /// fixed edge. `crossed` is overwritten.
  void insert(CrossedCavity& crossed)
  {
    this->Removed = crossed.Triangles.data() + crossed.Count;
    this->findInnerEdges(crossed);
    const Link onLeft = this->fill<true>(crossed);
    const Link onRight = this->fill<false>(crossed);
    const ChainVertex& a = crossed.Chains[0][0];
    const ChainVertex& b = crossed.Chains[0][crossed.ChainEnds[0] - 1];
    this->Mesh.attach(onLeft, onRight | ConstrainedMesh::FixedBit);
    this->Mesh.setOut(a.Vertex, onLeft);
    this->Mesh.setOut(b.Vertex, onRight);
    this->legalize();
  }

private:
  using Link = ConstrainedMesh::Link;
  using ChainVertex = CrossedCavity::ChainVertex;

  /// An edge with crossed triangles on both sides that is not crossed itself is in a chain twice.
  /// Its links become ~(2 i), or ~(2 i + 1) if it is fixed, where i is its index in Inner.
  void findInnerEdges(CrossedCavity& crossed)
  {
    // In a short chain, such an edge ends at a single vertex between two occurrences of another.
    constexpr std::size_t longest = 7;
    if (!crossed.HasRepeated && std::max(crossed.ChainEnds[0], crossed.ChainEnds[1]) <= longest)
    {
      return;
    }
    const Index mark = this->Mesh.newMark();
    for (std::size_t i = 0; i < crossed.Count; ++i)
    {
      this->Mesh.setMark(crossed.Triangles[i], mark);
    }
    this->Inner.clear();
    for (std::size_t chain = 0; chain < 2; ++chain)
    {
      for (std::size_t i = 1; i < crossed.ChainEnds[chain]; ++i)
      {
        ChainVertex& v = crossed.Chains[chain][i];
        const Index twin = ConstrainedMesh::twinOf(v.Outer);
        if (this->Mesh.mark(ConstrainedMesh::triangleOf(twin)) == mark)
        {
          this->setInner(v, twin);
        }
      }
    }
  }

  void setInner(ChainVertex& v, Index twin)
  {
    const Link known = this->Mesh.link(this->Mesh.twin(twin));
    if (known < 0) // set below when the edge's other half-edge was found
    {
      v.Outer = known;
      return;
    }
    v.Outer = ~(Link(2 * this->Inner.size()) + (ConstrainedMesh::isFixed(v.Outer) ? 1 : 0));
    this->Inner.push_back(ConstrainedMesh::NoIndex);
    this->Mesh.setLink(twin, v.Outer);
  }

  /// Makes a new half-edge the twin of the half-edge that was outside of the removed triangle.
  void attach(Index half, Link outer)
  {
    if (outer >= 0)
    {
      this->Mesh.attach(half, outer);
      return;
    }
    Index& first = this->Inner[std::size_t(~outer / 2)];
    if (first == ConstrainedMesh::NoIndex)
    {
      first = half;
    }
    else
    {
      this->Mesh.attach(half, first | (~outer % 2 != 0 ? ConstrainedMesh::FixedBit : 0));
    }
  }

  /// Triangulates the area between a chain and the segment. Returns the segment's half-edge.
  template <bool isLeft>
  Link fill(CrossedCavity& crossed)
  {
    constexpr std::size_t longest = 32;
    constexpr std::size_t chain = isLeft ? 0 : 1;
    const std::size_t count = crossed.ChainEnds[chain];
    ChainVertex* const first = crossed.Chains[chain].data();
    ChainVertex* const last = first + count - 1;
    return count > longest ? this->cutEars<isLeft>(first, last)
                           : this->triangulateChain<isLeft>(first, last);
  }

  /// Triangulates the area between a chain and the segment, so that it is Delaunay under the tie
  /// rule. Every vertex sees the segment along a crossed edge, and these lines of sight do not
  /// meet. Returns the segment's half-edge.
  ///
  /// The vertex whose circle with the segment's ends contains no other is the apex of the segment's
  /// triangle, whose other sides take the segment's part for the two halves of the chain (Anglada
  /// 1997). All vertices of a half are beyond its side, since their lines of sight cross it. A
  /// vertex is in the chain twice if other vertices are between its lines of sight. These are in
  /// its triangle with the segment's ends, so the vertex becomes an apex after them, when the chain
  /// has been divided between its two occurrences. Takes quadratic time at worst.
  template <bool isLeft>
  Link triangulateChain(const ChainVertex* first, const ChainVertex* last)
  {
    const Point2 from = isLeft ? first->Position : last->Position;
    const Point2 to = isLeft ? last->Position : first->Position;
    switch (last - first)
    {
      case 1:
        return last->Outer;
      case 2:
        return this->makeTriangle<isLeft>(
          first->Vertex, first[1].Outer, first[1].Vertex, last->Outer, last->Vertex);
      case 3:
      {
        // Without branches, which would be mispredicted half of the time. The apex is the second or
        // the first vertex; the other triangle is before or after it.
        const bool isSecond = inCirclePerturbed(from, to, first[1].Position, first[2].Position);
        const ChainVertex* const p = first + (isSecond ? 0 : 1);
        const Link other =
          this->makeTriangle<isLeft>(p->Vertex, p[1].Outer, p[1].Vertex, p[2].Outer, p[2].Vertex);
        const Link before = isSecond ? other : first[1].Outer;
        const Link after = isSecond ? last->Outer : other;
        return this->makeTriangle<isLeft>(
          first->Vertex, before, first[isSecond ? 2 : 1].Vertex, after, last->Vertex);
      }
      default:
        break;
    }
    const ChainVertex* apex = first + 1;
    ViewAngle largest(from, to, apex->Position);
    for (const ChainVertex* v = apex + 1; v != last; ++v)
    {
      const ViewAngle angle(from, to, v->Position);
      const bool isLarger = angle.isLarger(
        largest, [&] { return inCirclePerturbed(from, to, apex->Position, v->Position); });
      apex = isLarger ? v : apex;
      largest.replaceIf(isLarger, angle);
    }
    const Link before = this->triangulateChain<isLeft>(first, apex);
    const Link after = this->triangulateChain<isLeft>(apex, last);
    return this->makeTriangle<isLeft>(first->Vertex, before, apex->Vertex, after, last->Vertex);
  }

  /// As triangulateChain(), for any length. The edges inside are not locally Delaunay until
  /// legalize().
  template <bool isLeft>
  Link cutEars(ChainVertex* first, ChainVertex* last)
  {
    // The remaining vertices overwrite the start of the chain.
    constexpr int ear = isLeft ? -1 : 1;
    ChainVertex* end = first + 1;
    for (const ChainVertex* v = first + 1; v <= last; ++v)
    {
      *end++ = *v;
      while (
        end - first > 2 && orientation(end[-3].Position, end[-2].Position, end[-1].Position) == ear)
      {
        end[-1].Outer = this->makeTriangle<isLeft>(
          end[-3].Vertex, end[-2].Outer, end[-2].Vertex, end[-1].Outer, end[-1].Vertex);
        this->Suspects.push_back(end[-1].Outer);
        end[-2] = end[-1];
        --end;
      }
    }
    if (end - first != 2)
    {
      throw std::logic_error("A constraint's cavity cannot be triangulated.");
    }
    this->Suspects.pop_back(); // the segment itself
    return end[-1].Outer;
  }

  /// Makes a triangle of three vertices in the order of the chain. Returns the half-edge between
  /// the first and the last one.
  template <bool isLeft>
  Link makeTriangle(Index first, Link before, Index apex, Link after, Index last)
  {
    const Index t = *--this->Removed;
    this->Mesh.setCorners(t, apex, isLeft ? first : last, isLeft ? last : first);
    this->attach(t + (isLeft ? 2 : 1), before);
    this->attach(t + (isLeft ? 1 : 2), after);
    this->Mesh.setOut(apex, ConstrainedMesh::halfFrom(t, 0));
    return t;
  }

  void legalize()
  {
    while (!this->Suspects.empty())
    {
      const Index h = this->Suspects.back();
      this->Suspects.pop_back();
      if (this->mustFlip(h))
      {
        this->flip(h);
      }
    }
  }

  bool mustFlip(Index h) const
  {
    const ConstrainedMesh& mesh = this->Mesh;
    const Link link = mesh.link(h);
    const Index beyond = mesh.apex(ConstrainedMesh::twinOf(link));
    return !ConstrainedMesh::isFixed(link) && beyond != ConstrainedMesh::Infinite &&
      inCirclePerturbed(
        mesh.at(mesh.from(h)), mesh.at(mesh.to(h)), mesh.at(mesh.apex(h)), mesh.at(beyond));
  }

  /// Replaces an edge by the other diagonal of its two triangles.
  void flip(Index h)
  {
    ConstrainedMesh& mesh = this->Mesh;
    const Index g = mesh.twin(h);
    // The edge goes from p to q; r is the apex on its left, s on its right.
    const Index p = mesh.from(h);
    const Index q = mesh.to(h);
    const Index r = mesh.apex(h);
    const Index s = mesh.apex(g);
    const Link qr = mesh.link(mesh.next(h));
    const Link rp = mesh.link(mesh.previous(h));
    const Link ps = mesh.link(mesh.next(g));
    const Link sq = mesh.link(mesh.previous(g));
    const Index one = mesh.triangleOf(h);
    const Index other = mesh.triangleOf(g);
    mesh.setCorners(one, p, s, r);
    mesh.setCorners(other, q, r, s);
    const auto setSide = [&](Index half, Link outer)
    {
      mesh.attach(half, outer);
      this->Suspects.push_back(half);
    };
    setSide(one + 2, ps);
    setSide(one + 1, rp);
    setSide(other + 2, qr);
    setSide(other + 1, sq);
    mesh.attach(one, other);
    mesh.setOut(p, one + 2);
    mesh.setOut(s, one);
    mesh.setOut(q, other + 2);
    mesh.setOut(r, other);
  }

  ConstrainedMesh& Mesh;
  const Index* Removed = nullptr; ///< one past the crossed triangles that have not been reused yet
  std::vector<Index> Inner;       ///< by inner edge: a new half-edge, or NoIndex
  std::vector<Index> Suspects;    ///< half-edges that may have to be flipped
};

} // namespace tipp

#endif
