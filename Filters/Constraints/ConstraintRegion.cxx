// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintRegion.h"

#include "Constraints/Constraint.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tipp
{

void ConstraintRegion::clear()
{
  this->Numbers.clear();
  this->Vertices.clear();
  this->Corners.clear();
  this->Out.clear();
}

void ConstraintRegion::add(
  const std::array<PointId, 3>& ids, const std::array<Point2, 3>& positions)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto [v, isNew] = this->Numbers.insert(ids[i]);
    if (isNew)
    {
      this->Vertices.push_back({ ids[i], positions[i] });
      this->Out.push_back(None);
    }
    this->Out[std::size_t(v)] = Index(this->Corners.size());
    this->Corners.push_back(v);
  }
}

void ConstraintRegion::finish()
{
  this->Twins.assign(this->Corners.size(), None);
  this->Fixed.assign(this->Corners.size(), 0);
  this->matchEdges();
}

void ConstraintRegion::matchEdges()
{
  this->Edges.clear();
  this->HalfOfEdge.clear();
  for (Index h = 0; h < Index(this->Corners.size()); ++h)
  {
    const auto [low, high] = std::minmax({ this->from(h), this->to(h) });
    const auto [edge, isNew] = this->Edges.insert(std::int64_t(low) << 32 | high);
    isNew ? this->HalfOfEdge.push_back(h) : this->join(this->HalfOfEdge[std::size_t(edge)], h);
  }
  this->Borders.clear();
  this->FirstBorder.assign(this->Vertices.size(), None);
  for (const Index h : this->HalfOfEdge)
  {
    if (this->twin(h) == None)
    {
      Index& first = this->FirstBorder[std::size_t(this->from(h))];
      const auto border = Index(this->Borders.size());
      this->Borders.push_back({ h, first });
      first = border;
      this->Twins[std::size_t(h)] = ~border;
    }
  }
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
    const Index border = ~outer;
    this->Borders[std::size_t(border)].Half = half;
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
  const Index from = this->Numbers.find(a);
  const Index to = this->Numbers.find(b);
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

/// Returns the half-edge ab or its twin if ab is an edge; otherwise the half-edge from a in whose
/// triangle the segment ab starts, or None.
ConstraintRegion::Index ConstraintRegion::findToward(Index a, Index b, bool& isEdge) const
{
  Index border = this->FirstBorder[std::size_t(a)];
  if (border == None)
  {
    return this->sweep(this->Out[std::size_t(a)], b, isEdge);
  }
  Index found = None;
  while (found == None && border != None)
  {
    found = this->sweep(this->Borders[std::size_t(border)].Half, b, isEdge);
    border = this->Borders[std::size_t(border)].Next;
  }
  return found;
}

/// As findToward(), for the triangles around a vertex, counter-clockwise from `first`, one of its
/// half-edges.
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

/// Inserts ab, which starts in the triangle of `first`, a half-edge from a.
void ConstraintRegion::insertAcross(Index a, Index b, Index first)
{
  this->Crossed.assign(1, next(first));
  for (;;)
  {
    const Index crossed = this->Crossed.back();
    const Index half = this->twin(crossed);
    if (this->isFixed(crossed))
    {
      throw CrossingFound();
    }
    if (half < 0)
    {
      throw std::logic_error("A constraint leaves its region.");
    }
    const Index apex = this->from(previous(half));
    if (apex == b)
    {
      break;
    }
    const int side = this->turn(a, b, apex);
    if (side == 0)
    {
      throw std::logic_error("A vertex lies on a constraint that was not split there.");
    }
    this->Crossed.push_back(side > 0 ? next(half) : previous(half));
  }
  this->Inserter.insert(*this, a, b, this->Crossed);
}

void ConstraintRegion::setCorners(Index triangle, const std::array<Index, 3>& corners)
{
  for (Index i = 0; i < 3; ++i)
  {
    const Index v = corners[std::size_t(i)];
    this->Corners[3 * std::size_t(triangle) + std::size_t(i)] = v;
    this->Fixed[3 * std::size_t(triangle) + std::size_t(i)] = 0;
    this->Out[std::size_t(v)] = 3 * triangle + i;
  }
}

bool ConstraintRegion::isInCircle(Index a, Index b, Index c, Index d) const
{
  return inCirclePerturbed(this->at(a), this->at(b), this->at(c), this->at(d));
}

bool ConstraintRegion::mustFlip(Index half) const
{
  const Index twin = this->twin(half);
  return twin >= 0 && !this->isFixed(half) &&
    this->isInCircle(
      this->from(half), this->to(half), this->from(previous(half)), this->from(previous(twin)));
}

} // namespace tipp
