// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSegmentInserter_h
#define tippSegmentInserter_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

/// Inserts segments one by one into a constrained Delaunay triangulation.
///
/// A segment replaces the triangles that it crosses. On each side of the segment, the vertices of
/// these triangles form a chain from one end to the other. Every vertex sees the segment along a
/// crossed edge, and these lines of sight do not meet.
///
/// A short chain is triangulated by recursion (Anglada 1997): the vertex whose circle with the
/// segment's ends contains no other is the apex of the segment's triangle, whose other sides take
/// the segment's part for the two halves of the chain. All vertices of a half are beyond its side,
/// since their lines of sight cross it.
///
/// The recursion takes quadratic time at worst, and fails if a vertex is in the chain twice, which
/// happens if the chain follows an edge out and back. Long chains and such chains are triangulated
/// by ear clipping: three consecutive vertices that turn away from the segment enclose no other,
/// because of the lines of sight. Then edges are flipped until all are locally Delaunay, as in
/// CGAL's triangulation.
///
/// `Mesh` has counter-clockwise triangles, whose half-edge half(triangle, i) goes from corner i to
/// the next. For half-edges it has next(), previous(), from(), to(), twin() and triangleOf().
/// setCorners(triangle, corners) replaces a triangle and removes its twins and its mark;
/// markRemoved(triangle) sets this mark, and isRemoved(triangle) returns it. join(half, other)
/// makes twins. isFixed(half) and setFixed(half, fixed) concern one side of an edge. turn(a, b, c)
/// is the orientation of three vertices. isInCircle(a, b, c, d) says whether d is inside the circle
/// of a counter-clockwise triangle under the tie rule. mustFlip(half) is false for fixed edges and
/// edges with a single triangle.
template <typename Mesh>
class SegmentInserter
{
public:
  using Index = std::int32_t;

  /// Makes ab an edge. `crossed` are the half-edges that ab crosses, in order from a, each in the
  /// triangle that ab leaves there. None of them may be fixed.
  void insert(Mesh& mesh, Index a, Index b, const std::vector<Index>& crossed)
  {
    this->makeChains(mesh, a, crossed);
    if (this->HasDangling)
    {
      this->NewInner.clear();
    }
    const Index onLeft = this->fill(mesh, a, this->Left);
    const Index onRight = this->fill(mesh, b, this->Right);
    mesh.join(onLeft, onRight);
    mesh.setFixed(onLeft, true);
    mesh.setFixed(onRight, true);
    this->legalize(mesh);
  }

private:
  static constexpr Index None = -1;

  /// An edge of a chain, from the previous vertex to this one. The cavity is on its right.
  struct Link
  {
    Index To;
    Index Outer;     ///< the half-edge on the left
    Index OldInner;  ///< the half-edge of the removed triangle on the right
    bool IsFixed;    ///< whether it is an inserted segment
    bool IsDangling; ///< whether the cavity is on both sides
  };
  /// Consecutive links in the memory of Room.
  struct Chain
  {
    Link* Begin;
    Link* End;
  };

  static Link makeLink(const Mesh& mesh, Index to, Index inner)
  {
    return { to, mesh.twin(inner), inner, mesh.isFixed(inner), false };
  }

  /// Makes the chains on both sides of the segment.
  void makeChains(Mesh& mesh, Index a, const std::vector<Index>& crossed)
  {
    const std::size_t most = crossed.size() + 1; // at most this many links per chain
    if (this->Room.size() < 2 * most)
    {
      this->Room.resize(4 * most);
    }
    this->Removed.resize(most);
    this->Left = { this->Room.data(), this->Room.data() };
    this->Right = { this->Room.data() + 2 * most, this->Room.data() + 2 * most };
    const Index first = crossed.front();
    this->Removed[0] = mesh.triangleOf(first);
    *this->Left.End++ = makeLink(mesh, mesh.to(first), mesh.next(first));
    // The right chain goes from b to a, so it is filled from its last link.
    *--this->Right.Begin = makeLink(mesh, a, mesh.previous(first));
    Index onRight = mesh.from(first);
    for (std::size_t i = 0; i < crossed.size(); ++i)
    {
      const Index half = mesh.twin(crossed[i]);
      this->Removed[i + 1] = mesh.triangleOf(half);
      const Index right = mesh.next(half); // from the right end to the new vertex
      const Index left = mesh.previous(half);
      const Index apex = mesh.to(right);
      const Index leftBy = i + 1 < crossed.size() ? crossed[i + 1] : None;
      // Writes both and keeps one, because a branch would be mispredicted half of the time.
      *this->Left.End = makeLink(mesh, apex, left);
      this->Left.End += leftBy != left ? 1 : 0;
      this->Right.Begin[-1] = makeLink(mesh, onRight, right);
      this->Right.Begin -= leftBy != right ? 1 : 0;
      onRight = leftBy != right ? apex : onRight;
    }
    this->markDangling(mesh);
  }

  /// An edge with the cavity on both sides has a link for each of its half-edges.
  void markDangling(Mesh& mesh)
  {
    for (const Index triangle : this->Removed)
    {
      mesh.markRemoved(triangle);
    }
    this->HasDangling = false;
    for (const Chain& chain : { this->Left, this->Right })
    {
      for (Link* link = chain.Begin; link != chain.End; ++link)
      {
        link->IsDangling = link->Outer >= 0 && mesh.isRemoved(mesh.triangleOf(link->Outer));
        this->HasDangling |= link->IsDangling;
      }
    }
  }

  /// Triangulates the area between a chain and the segment that joins its ends. Returns the
  /// segment's half-edge.
  Index fill(Mesh& mesh, Index from, const Chain& chain)
  {
    constexpr std::ptrdiff_t shortChain = 32;
    return chain.End - chain.Begin > shortChain || this->HasDangling
      ? this->cutEars(mesh, from, chain)
      : this->replace(mesh, from, chain).Outer;
  }

  /// Triangulates the area between a chain, which starts at `from`, and the segment that joins its
  /// ends. Returns the link that replaces the chain.
  Link replace(Mesh& mesh, Index from, const Chain& chain)
  {
    if (chain.End - chain.Begin == 1)
    {
      return *chain.Begin;
    }
    const Index to = chain.End[-1].To;
    Link* apex = chain.Begin;
    for (Link* link = apex + 1; link + 1 != chain.End; ++link)
    {
      apex = mesh.isInCircle(from, to, apex->To, link->To) ? link : apex;
    }
    const Link first = this->replace(mesh, from, { chain.Begin, apex + 1 });
    const Link second = this->replace(mesh, apex->To, { apex + 1, chain.End });
    return { to, this->makeTriangle(mesh, first, from, second), None, false, false };
  }

  /// As fill(), for any chain. The edges inside are not locally Delaunay until legalize().
  Index cutEars(Mesh& mesh, Index from, const Chain& chain)
  {
    // The vertex before the first link is `from`. The remaining links overwrite the start of the
    // chain.
    Link* const rest = chain.Begin;
    std::size_t count = 0;
    for (const Link* link = chain.Begin; link != chain.End; ++link)
    {
      rest[count++] = *link;
      while (count > 1)
      {
        const Link& second = rest[count - 1];
        const Link& first = rest[count - 2];
        const Index x = count == 2 ? from : rest[count - 3].To;
        if (mesh.turn(x, first.To, second.To) >= 0)
        {
          break;
        }
        const Index half = this->makeTriangle(mesh, first, x, second);
        this->Suspects.push_back(half);
        rest[count - 2] = { second.To, half, None, false, false };
        --count;
      }
    }
    if (count != 1)
    {
      throw std::logic_error("A constraint's cavity cannot be triangulated.");
    }
    this->Suspects.pop_back(); // the segment itself
    return rest->Outer;
  }

  /// Makes the triangle on the right of two links. Returns the half-edge that replaces them.
  Index makeTriangle(Mesh& mesh, const Link& first, Index from, const Link& second)
  {
    const Index triangle = this->Removed.back();
    this->Removed.pop_back();
    mesh.setCorners(triangle, { from, second.To, first.To });
    this->attach(mesh, mesh.half(triangle, 1), second);
    this->attach(mesh, mesh.half(triangle, 2), first);
    return mesh.half(triangle, 0);
  }

  /// Makes a new half-edge the twin of the half-edge outside the removed one.
  void attach(Mesh& mesh, Index half, const Link& link)
  {
    mesh.setFixed(half, link.IsFixed);
    if (!link.IsDangling)
    {
      mesh.join(half, link.Outer);
      return;
    }
    const auto other = this->NewInner.find(link.Outer);
    if (other == this->NewInner.end())
    {
      this->NewInner.emplace(link.OldInner, half);
    }
    else
    {
      mesh.join(half, other->second);
    }
  }

  void legalize(Mesh& mesh)
  {
    while (!this->Suspects.empty())
    {
      const Index h = this->Suspects.back();
      this->Suspects.pop_back();
      if (mesh.mustFlip(h))
      {
        this->flip(mesh, h);
      }
    }
  }

  /// Replaces an edge by the other diagonal of its two triangles.
  void flip(Mesh& mesh, Index h)
  {
    const Index g = mesh.twin(h);
    // The edge goes from p to q; r is the apex on its left, s on its right.
    const Index p = mesh.from(h);
    const Index q = mesh.to(h);
    const Index r = mesh.from(mesh.previous(h));
    const Index s = mesh.from(mesh.previous(g));
    struct Side
    {
      Index Twin;
      bool IsFixed;
    };
    const auto side = [&mesh](Index half) { return Side{ mesh.twin(half), mesh.isFixed(half) }; };
    const Side qr = side(mesh.next(h));
    const Side rp = side(mesh.previous(h));
    const Side ps = side(mesh.next(g));
    const Side sq = side(mesh.previous(g));
    const Index one = mesh.triangleOf(h);
    const Index other = mesh.triangleOf(g);
    mesh.setCorners(one, { p, s, r });
    mesh.setCorners(other, { s, q, r });
    const auto setSide = [this, &mesh](Index half, const Side& old)
    {
      mesh.join(half, old.Twin);
      mesh.setFixed(half, old.IsFixed);
      this->Suspects.push_back(half);
    };
    setSide(mesh.half(one, 0), ps);
    setSide(mesh.half(one, 2), rp);
    setSide(mesh.half(other, 0), sq);
    setSide(mesh.half(other, 1), qr);
    mesh.join(mesh.half(one, 1), mesh.half(other, 2));
  }

  std::vector<Index> Removed; ///< crossed triangles that have not been reused yet
  std::vector<Link> Room;     ///< memory of the links of Left and Right
  Chain Left{};
  Chain Right{};
  bool HasDangling = false;                  ///< whether a link of Left or Right is dangling
  std::vector<Index> Suspects;               ///< half-edges that may have to be flipped
  std::unordered_map<Index, Index> NewInner; ///< new half-edges by old ones, at dangling edges
};

} // namespace tipp

#endif
