// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/ConstraintRegion.h"

#include "Constraints/Constraint.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tipp
{

ConstraintRegion::ConstraintRegion()
  : Walker(this->Mesh)
  , Inserter(this->Mesh)
{
}

void ConstraintRegion::clear()
{
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  constexpr PointId none = -1;
  this->Numbers.clear();
  this->Ids.assign(1, none); // the infinite vertex
  this->Positions.assign(1, { nowhere, nowhere });
  this->Slots.clear();
  this->Count = 0;
}

void ConstraintRegion::add(
  const std::array<PointId, 3>& ids, const std::array<Point2, 3>& positions)
{
  std::array<Index, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto [number, isNew] = this->Numbers.insert(ids[i]);
    if (isNew)
    {
      this->Ids.push_back(ids[i]);
      this->Positions.push_back(positions[i]);
    }
    corners[i] = number + 1;
  }
  this->append(corners);
  ++this->Count;
}

ConstraintRegion::Index ConstraintRegion::append(const std::array<Index, 3>& corners)
{
  constexpr Index none = ConstrainedMesh::None;
  const auto triangle = Index(this->Slots.size());
  this->Slots.insert(
    this->Slots.end(), { corners[0], corners[1], corners[2], 0, none, none, none, 0 });
  return triangle;
}

void ConstraintRegion::join(Index h, Index g)
{
  this->Slots[std::size_t(h) + 4] = g;
  this->Slots[std::size_t(g) + 4] = h;
}

void ConstraintRegion::finish()
{
  this->joinInside();
  this->surround();
  this->Mesh.begin(
    this->Slots.data(), Index(this->Slots.size()), this->Positions.data(), this->Positions.size());
}

void ConstraintRegion::joinInside()
{
  this->Edges.clear();
  this->HalfOfEdge.clear();
  for (std::size_t corner = 0; corner < 3 * this->Count; ++corner)
  {
    const Index h = halfEdge(corner);
    const auto [low, high] = std::minmax({ this->from(h), this->to(h) });
    const auto [edge, isNew] = this->Edges.insert(std::int64_t(low) << 32 | high);
    isNew ? this->HalfOfEdge.push_back(h) : this->join(h, this->HalfOfEdge[std::size_t(edge)]);
  }
}

/// Adds the triangles at the infinite vertex. All triangles around a vertex become neighbours in
/// turn, also those between which the region has several gaps.
void ConstraintRegion::surround()
{
  this->Outside.clear();
  this->FirstOutside.assign(this->Positions.size(), ConstrainedMesh::None);
  for (const Index h : this->HalfOfEdge)
  {
    if (this->Slots[std::size_t(h) + 4] == ConstrainedMesh::None)
    {
      const Index outside = this->append({ ConstrainedMesh::Infinite, this->to(h), this->from(h) });
      this->join(h, outside);
      Index& first = this->FirstOutside[std::size_t(this->from(h))];
      this->Outside.push_back({ outside, first });
      first = Index(this->Outside.size() - 1);
    }
  }
  for (const OutsideTriangle& one : this->Outside)
  {
    const Index from = this->Slots[std::size_t(one.Triangle) + 2];
    const Index next =
      one.Next != ConstrainedMesh::None ? one.Next : this->FirstOutside[std::size_t(from)];
    this->join(this->Outside[std::size_t(next)].Triangle + 1, this->lastAfter(one.Triangle) + 2);
  }
}

/// The infinite triangle after the triangles inside that follow `outside` counter-clockwise around
/// the start of its edge.
ConstraintRegion::Index ConstraintRegion::lastAfter(Index outside) const
{
  Index h = this->twin(outside);
  while (!this->isOutside(h))
  {
    h = this->twin(HalfEdgeMesh::previous(h));
  }
  return HalfEdgeMesh::triangleOf(h);
}

void ConstraintRegion::insert(PointId a, PointId b)
{
  const Index from = this->Numbers.find(a) + 1;
  const Index to = this->Numbers.find(b) + 1;
  if (from == ConstrainedMesh::Infinite || to == ConstrainedMesh::Infinite)
  {
    return;
  }
  const DirectedLine line{ this->Mesh.at(from), this->Mesh.at(to), to };
  const LineWalk walk = this->Walker.walk(line, from);
  if (walk.How == LineWalk::End::Touched)
  {
    throw std::logic_error("A vertex lies on a constraint that was not split there.");
  }
  if (walk.Edge != LineWalk::None)
  {
    this->Mesh.fix(walk.Edge);
  }
  else if (walk.How == LineWalk::End::Reached)
  {
    this->Inserter.insert(this->Walker.crossed());
  }
  else if (this->Walker.crossed().Count > 0)
  {
    throw std::logic_error("A constraint leaves its region.");
  }
}

} // namespace tipp
