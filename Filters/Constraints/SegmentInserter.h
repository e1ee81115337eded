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
/// A segment replaces the triangles that it crosses (Anglada 1997). On each side of it their
/// vertices are a chain from one end to the other. An ear of the chain is cut off until the segment
/// is left. There always is one: every vertex sees the segment along an edge that was crossed,
/// these lines of sight do not meet, and so three vertices in a row that turn away from the segment
/// enclose nothing. Then edges are flipped until all are locally Delaunay, as in CGAL's
/// triangulation.
///
/// `Mesh` has counter-clockwise triangles and the half-edge half(triangle, i) from corner i to the
/// next; next(), previous(), from(), to(), twin() and triangleOf() of half-edges;
/// setCorners(triangle, corners), which removes the triangle's connections, and its mark of
/// markRemoved(triangle), which isRemoved(triangle) tells; join(half, other) for
/// twins; isFixed(half) and setFixed(half, fixed) for one side of an edge; turn(a, b, c) of
/// vertices; and mustFlip(half), false for edges that are fixed or have one triangle.
template <typename Mesh>
class SegmentInserter
{
public:
  using Index = std::int32_t;

  /// Makes ab an edge. Crossed: the half-edges that it crosses, from a on, each in the triangle
  /// that it leaves there; none of them is fixed.
  void insert(Mesh& mesh, Index a, Index b, const std::vector<Index>& crossed)
  {
    this->makeChains(mesh, a, crossed);
    if (!this->NewInner.empty()) // clear() is slow even then
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

  /// An edge of a chain, from the vertex before to this one, with the cavity on its right.
  struct Link
  {
    Index To;
    Index Outer;     ///< the half-edge on its left
    Index OldInner;  ///< the half-edge of the removed triangle on its right
    bool IsFixed;    ///< an inserted segment
    bool IsDangling; ///< the cavity is on both sides
  };
  /// Links in their order; memory of Room.
  struct Chain
  {
    Link* Begin;
    Link* End;
  };

  static Link makeLink(const Mesh& mesh, Index to, Index inner)
  {
    return { to, mesh.twin(inner), inner, mesh.isFixed(inner), false };
  }

  /// What the segment leaves on its two sides.
  void makeChains(Mesh& mesh, Index a, const std::vector<Index>& crossed)
  {
    const std::size_t most = crossed.size() + 1; // links of a chain
    if (this->Room.size() < 2 * most)
    {
      this->Room.resize(4 * most);
    }
    this->Removed.resize(most);
    this->Left = { this->Room.data(), this->Room.data() };
    this->Right = { this->Room.data() + 2 * most, this->Room.data() + 2 * most };
    const auto addLeft = [&](Index to, Index inner)
    { *this->Left.End++ = makeLink(mesh, to, inner); };
    // On the right from b to a, so from the last link on.
    Index onRight = a;
    const auto addRight = [&](Index from, Index inner)
    {
      *--this->Right.Begin = makeLink(mesh, onRight, inner);
      onRight = from;
    };
    const Index first = crossed.front();
    this->Removed[0] = mesh.triangleOf(first);
    addLeft(mesh.to(first), mesh.next(first));
    addRight(mesh.from(first), mesh.previous(first));
    for (std::size_t i = 0; i < crossed.size(); ++i)
    {
      const Index half = mesh.twin(crossed[i]);
      this->Removed[i + 1] = mesh.triangleOf(half);
      const Index right = mesh.next(half); // from the right to the new vertex
      const Index left = mesh.previous(half);
      const Index apex = mesh.to(right);
      const Index leftBy = i + 1 < crossed.size() ? crossed[i + 1] : None;
      leftBy != right ? addRight(apex, right) : void();
      leftBy != left ? addLeft(apex, left) : void();
    }
    this->markDangling(mesh);
  }

  /// An edge with the cavity on both sides is in the chains twice, once for each of its half-edges.
  void markDangling(Mesh& mesh)
  {
    for (const Index triangle : this->Removed)
    {
      mesh.markRemoved(triangle);
    }
    for (const Chain& chain : { this->Left, this->Right })
    {
      for (Link* link = chain.Begin; link != chain.End; ++link)
      {
        link->IsDangling = link->Outer >= 0 && mesh.isRemoved(mesh.triangleOf(link->Outer));
      }
    }
  }

  /// Triangulates between a chain and the segment of its ends. Returns the half-edge of the
  /// segment.
  Index fill(Mesh& mesh, Index from, const Chain& chain)
  {
    // The vertex before the first link is `from`. What is left of the chain overwrites it.
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
    this->Suspects.pop_back(); // the segment
    return rest->Outer;
  }

  /// The triangle on the right of two links; returns the half-edge that replaces them.
  Index makeTriangle(Mesh& mesh, const Link& first, Index from, const Link& second)
  {
    const Index triangle = this->Removed.back();
    this->Removed.pop_back();
    mesh.setCorners(triangle, { from, second.To, first.To });
    this->attach(mesh, mesh.half(triangle, 1), second);
    this->attach(mesh, mesh.half(triangle, 2), first);
    return mesh.half(triangle, 0);
  }

  /// Joins a new half-edge with what was on the other side of the removed one.
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
    // p, q: the edge; r on its left, s on its right.
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

  std::vector<Index> Removed; ///< crossed triangles that are not used again yet
  std::vector<Link> Room;     ///< for Left and Right
  Chain Left{};
  Chain Right{};
  std::vector<Index> Suspects;               ///< half-edges that may have to be flipped
  std::unordered_map<Index, Index> NewInner; ///< of old half-edges at dangling edges: the new ones
};

} // namespace tipp

#endif
