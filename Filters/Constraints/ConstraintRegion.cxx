// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintRegion.h"

#include "Predicates/InCircle.h"
#include "Predicates/Orientation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

constexpr std::int32_t None = -1;

} // namespace

void ConstraintRegion::clear()
{
  this->Vertices.clear();
  this->AddedIds.clear();
}

void ConstraintRegion::add(
  const std::array<PointId, 3>& ids, const std::array<Point2, 3>& positions)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    this->Vertices.push_back({ ids[i], positions[i] });
    this->AddedIds.push_back(ids[i]);
  }
}

void ConstraintRegion::finish()
{
  std::sort(this->Vertices.begin(), this->Vertices.end(),
    [](const Vertex& a, const Vertex& b) { return a.Id < b.Id; });
  this->Vertices.erase(std::unique(this->Vertices.begin(), this->Vertices.end(),
                         [](const Vertex& a, const Vertex& b) { return a.Id == b.Id; }),
    this->Vertices.end());
  const std::size_t halfEdges = this->AddedIds.size();
  this->Corners.resize(halfEdges);
  this->Twins.resize(halfEdges);
  this->Fixed.assign(halfEdges, 0);
  this->IsRemoved.assign(halfEdges / 3, 0);
  this->NewInner.assign(halfEdges, None);
  this->Out.resize(this->Vertices.size());
  for (std::size_t h = 0; h < halfEdges; ++h)
  {
    const Index v = this->find(this->AddedIds[h]);
    this->Corners[h] = v;
    this->Out[std::size_t(v)] = Index(h);
  }
  this->matchEdges();
}

void ConstraintRegion::matchEdges()
{
  using Edge = std::pair<std::pair<Index, Index>, Index>;
  std::vector<Edge> edges;
  edges.reserve(this->Corners.size());
  for (Index h = 0; h < Index(this->Corners.size()); ++h)
  {
    edges.push_back({ std::minmax(this->from(h), this->to(h)), h });
  }
  std::sort(edges.begin(), edges.end());
  this->Borders.clear();
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const Index h = edges[i].second;
    if (i + 1 < edges.size() && edges[i].first == edges[i + 1].first)
    {
      const Index twin = edges[++i].second;
      this->Twins[std::size_t(h)] = twin;
      this->Twins[std::size_t(twin)] = h;
    }
    else
    {
      this->Borders.push_back({ this->from(h), h });
    }
  }
  std::sort(this->Borders.begin(), this->Borders.end(),
    [](const BorderEdge& a, const BorderEdge& b)
    { return a.From < b.From || (a.From == b.From && a.Half < b.Half); });
  for (std::size_t i = 0; i < this->Borders.size(); ++i)
  {
    this->Twins[std::size_t(this->Borders[i].Half)] = ~Index(i);
  }
}

ConstraintRegion::Index ConstraintRegion::find(PointId id) const
{
  const auto found = std::lower_bound(this->Vertices.begin(), this->Vertices.end(), id,
    [](const Vertex& vertex, PointId wanted) { return vertex.Id < wanted; });
  return found != this->Vertices.end() && found->Id == id ? Index(found - this->Vertices.begin())
                                                          : None;
}

int ConstraintRegion::turn(Index a, Index b, Index c) const
{
  return orientation(this->at(a), this->at(b), this->at(c));
}

void ConstraintRegion::join(Index half, Index outer)
{
  this->Twins[std::size_t(half)] = outer;
  if (outer < 0)
  {
    this->Borders[std::size_t(~outer)].Half = half;
  }
  else
  {
    this->Twins[std::size_t(outer)] = half;
  }
}

void ConstraintRegion::fix(Index half)
{
  this->Fixed[std::size_t(half)] = 1;
  if (this->twin(half) >= 0)
  {
    this->Fixed[std::size_t(this->twin(half))] = 1;
  }
}

void ConstraintRegion::insert(PointId a, PointId b)
{
  const Index from = this->find(a);
  const Index to = this->find(b);
  if (from == None || to == None)
  {
    return;
  }
  bool isEdge = false;
  const Index first = this->findToward(from, to, isEdge);
  if (first != None)
  {
    isEdge ? this->fix(first) : this->insertAcross(from, to, first);
  }
}

/// The half-edge ab or its twin; or the one from a in whose triangle b's direction lies; or None.
ConstraintRegion::Index ConstraintRegion::findToward(Index a, Index b, bool& isEdge) const
{
  auto border = std::lower_bound(this->Borders.begin(), this->Borders.end(), a,
    [](const BorderEdge& edge, Index vertex) { return edge.From < vertex; });
  if (border == this->Borders.end() || border->From != a)
  {
    return this->sweep(this->Out[std::size_t(a)], b, isEdge);
  }
  Index found = None;
  for (; found == None && border != this->Borders.end() && border->From == a; ++border)
  {
    found = this->sweep(border->Half, b, isEdge);
  }
  return found;
}

/// The same among the triangles round a vertex from one of its half-edges on, counter-clockwise.
ConstraintRegion::Index ConstraintRegion::sweep(Index first, Index b, bool& isEdge) const
{
  const Index a = this->from(first);
  Index h = first;
  int side = this->to(h) == b ? 0 : this->turn(a, this->to(h), b);
  do
  {
    const Index back = previous(h);
    if (this->to(h) == b || this->from(back) == b)
    {
      isEdge = true;
      return this->to(h) == b ? h : back;
    }
    const int nextSide = this->turn(a, this->from(back), b);
    if (side > 0 && nextSide < 0)
    {
      return h;
    }
    side = nextSide;
    h = this->twin(back);
  } while (h >= 0 && h != first);
  return None;
}

void ConstraintRegion::remove(Index half, std::vector<Index>& removed)
{
  this->IsRemoved[std::size_t(half / 3)] = 1;
  removed.push_back(half / 3);
}

ConstraintRegion::Link ConstraintRegion::makeLink(Index to, Index inner) const
{
  return { to, this->twin(inner), inner, this->Fixed[std::size_t(inner)] != 0, false };
}

void ConstraintRegion::markDangling(Chain& chain)
{
  for (Link& link : chain)
  {
    link.IsDangling = link.Outer >= 0 && this->IsRemoved[std::size_t(link.Outer / 3)];
  }
}

/// Inserts ab, which begins in the triangle of `first`, a half-edge from a.
void ConstraintRegion::insertAcross(Index a, Index b, Index first)
{
  std::vector<Index> removed;
  Chain left;  // from a to b
  Chain right; // from b to a, in reverse order; each link's To is the vertex that it comes from
  this->remove(first, removed);
  right.push_back(this->makeLink(this->to(first), first));
  left.push_back(this->makeLink(this->from(previous(first)), previous(first)));
  for (Index crossed = next(first);;)
  {
    const Index half = this->twin(crossed);
    if (half < 0 || this->Fixed[std::size_t(crossed)])
    {
      throw std::logic_error("A constraint leaves its region or crosses another one.");
    }
    this->remove(half, removed);
    const Index onRight = next(half); // from the right to the new vertex
    const Index onLeft = previous(half);
    const Index apex = this->to(onRight);
    const int side = apex == b ? 0 : this->turn(a, b, apex);
    if (side <= 0)
    {
      right.push_back(this->makeLink(apex, onRight));
    }
    if (side >= 0)
    {
      left.push_back(this->makeLink(apex, onLeft));
    }
    if (apex == b)
    {
      break;
    }
    if (side == 0)
    {
      throw std::logic_error("A vertex lies on a constraint that was not split there.");
    }
    crossed = side > 0 ? onRight : onLeft;
  }
  // Each link to the vertex where it goes, from b on.
  std::reverse(right.begin(), right.end());
  for (std::size_t i = 0; i + 1 < right.size(); ++i)
  {
    right[i].To = right[i + 1].To;
  }
  right.back().To = a;
  this->markDangling(left);
  this->markDangling(right);
  for (const Index t : removed)
  {
    this->IsRemoved[std::size_t(t)] = 0;
  }
  const Index onLeft = this->fill(a, left, removed);
  const Index onRight = this->fill(b, right, removed);
  this->join(onLeft, onRight);
  this->fix(onLeft);
  this->legalize();
}

/// Triangulates between a chain and the segment of its ends. Returns the half-edge of the segment.
ConstraintRegion::Index ConstraintRegion::fill(
  Index from, const Chain& chain, std::vector<Index>& slots)
{
  Chain rest; // the vertex before its first link is `from`
  for (const Link& link : chain)
  {
    rest.push_back(link);
    while (rest.size() > 1)
    {
      const Link& second = rest.back();
      const Link& first = rest[rest.size() - 2];
      const Index x = rest.size() == 2 ? from : rest[rest.size() - 3].To;
      if (this->turn(x, first.To, second.To) >= 0)
      {
        break;
      }
      const Index half = this->makeTriangle(first, x, second, slots.back());
      slots.pop_back();
      this->Suspects.push_back(half);
      const Index to = second.To;
      rest.resize(rest.size() - 2);
      rest.push_back({ to, half, None, false, false });
    }
  }
  if (rest.size() != 1)
  {
    throw std::logic_error("A constraint's cavity cannot be triangulated.");
  }
  this->Suspects.pop_back(); // the segment
  return rest.front().Outer;
}

/// The triangle on the right of two links; returns the half-edge that replaces them.
ConstraintRegion::Index ConstraintRegion::makeTriangle(
  const Link& first, Index from, const Link& second, Index slot)
{
  const Index half = 3 * slot;
  const std::array<Index, 3> corners{ from, second.To, first.To };
  for (Index i = 0; i < 3; ++i)
  {
    const Index v = corners[std::size_t(i)];
    this->Corners[std::size_t(half + i)] = v;
    this->Fixed[std::size_t(half + i)] = 0;
    this->Out[std::size_t(v)] = half + i;
  }
  this->attach(half + 1, second);
  this->attach(half + 2, first);
  return half;
}

/// Joins a new half-edge with what was on the other side of the removed one.
void ConstraintRegion::attach(Index half, const Link& link)
{
  this->Fixed[std::size_t(half)] = link.IsFixed;
  if (!link.IsDangling)
  {
    this->join(half, link.Outer);
    return;
  }
  const Index other = std::exchange(this->NewInner[std::size_t(link.Outer)], None);
  if (other == None)
  {
    this->NewInner[std::size_t(link.OldInner)] = half;
  }
  else
  {
    this->join(half, other);
  }
}

void ConstraintRegion::legalize()
{
  while (!this->Suspects.empty())
  {
    const Index h = this->Suspects.back();
    this->Suspects.pop_back();
    const Index g = this->twin(h);
    if (g >= 0 && !this->Fixed[std::size_t(h)] &&
      inCirclePerturbed(this->at(this->from(h)), this->at(this->to(h)),
        this->at(this->from(previous(h))), this->at(this->from(previous(g)))))
    {
      this->flip(h);
    }
  }
}

/// Replaces an edge by the other diagonal of its two triangles.
void ConstraintRegion::flip(Index h)
{
  const Index g = this->twin(h);
  // p, q: the edge; r on its left, s on its right.
  const Index p = this->from(h);
  const Index q = this->to(h);
  const Index r = this->from(previous(h));
  const Index s = this->from(previous(g));
  struct Side
  {
    Index Twin;
    char IsFixed;
  };
  const auto side = [this](Index half) {
    return Side{ this->twin(half), this->Fixed[std::size_t(half)] };
  };
  const Side qr = side(next(h));
  const Side rp = side(previous(h));
  const Side ps = side(next(g));
  const Side sq = side(previous(g));
  const Index one = 3 * (h / 3);   // p, s, r
  const Index other = 3 * (g / 3); // s, q, r
  const std::array<std::pair<Index, Index>, 6> corners{ { { one, p }, { one + 1, s },
    { one + 2, r }, { other, s }, { other + 1, q }, { other + 2, r } } };
  for (const auto& [half, v] : corners)
  {
    this->Corners[std::size_t(half)] = v;
    this->Out[std::size_t(v)] = half;
  }
  const auto place = [this](Index half, const Side& old)
  {
    this->join(half, old.Twin);
    this->Fixed[std::size_t(half)] = old.IsFixed;
    this->Suspects.push_back(half);
  };
  place(one, ps);
  place(one + 2, rp);
  place(other, sq);
  place(other + 1, qr);
  this->join(one + 1, other + 2);
  this->Fixed[std::size_t(one + 1)] = 0;
  this->Fixed[std::size_t(other + 2)] = 0;
}

} // namespace tipp
