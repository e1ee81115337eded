// SPDX-License-Identifier: BSD-3-Clause
#include "Check/MeshEdges.h"

#include <tuple>

namespace tipp
{
namespace check
{

MeshEdges::MeshEdges(const std::vector<double>& xy, const std::vector<std::int64_t>& triangles)
  : XY(xy)
{
  const std::int64_t points = std::int64_t(xy.size() / 2);
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3)
  {
    const std::int64_t* const corners = &triangles[t];
    if (std::any_of(corners, corners + 3,
          [&](std::int64_t id) { return id < 0 || id >= points || !isFinite(this->at(id)); }))
    {
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->Edges.push_back({ corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3] });
      this->Edges.push_back({ corners[(k + 1) % 3], corners[k], None });
    }
  }
  // The entry with a triangle comes first and is kept.
  std::sort(this->Edges.begin(), this->Edges.end(),
    [](const Edge& a, const Edge& b)
    { return std::tie(a.From, a.To, b.Left) < std::tie(b.From, b.To, a.Left); });
  const auto end = std::unique(this->Edges.begin(), this->Edges.end(),
    [](const Edge& a, const Edge& b) { return a.From == b.From && a.To == b.To; });
  this->Edges.erase(end, this->Edges.end());
  for (const Edge& edge : this->Edges)
  {
    if (this->Vertices.empty() || this->Vertices.back() != edge.From)
    {
      this->Vertices.push_back(edge.From);
    }
  }
  std::sort(this->Vertices.begin(), this->Vertices.end(),
    [this](std::int64_t a, std::int64_t b) { return this->isBeforeAt(a, b); });
}

std::int64_t MeshEdges::vertexAt(Position p) const
{
  const auto found = std::lower_bound(this->Vertices.begin(), this->Vertices.end(), p,
    [this](std::int64_t vertex, Position wanted) { return isBefore(this->at(vertex), wanted); });
  return found == this->Vertices.end() || isBefore(p, this->at(*found)) ? None : *found;
}

std::size_t MeshEdges::firstFrom(std::int64_t vertex) const
{
  return std::size_t(std::lower_bound(this->Edges.begin(), this->Edges.end(), vertex,
                       [](const Edge& edge, std::int64_t from) { return edge.From < from; }) -
    this->Edges.begin());
}

std::int64_t MeshEdges::leftOf(std::int64_t from, std::int64_t to) const
{
  std::size_t i = this->firstFrom(from);
  while (this->isFrom(i, from) && this->Edges[i].To != to)
  {
    ++i;
  }
  return this->isFrom(i, from) ? this->Edges[i].Left : None;
}

bool MeshEdges::needsConstraint(std::int64_t a, std::int64_t b, bool tieRule, bool isCut) const
{
  const std::int64_t left = this->leftOf(a, b);
  const std::int64_t right = this->leftOf(b, a);
  if (left == None || right == None)
  {
    return isCut;
  }
  const Position from = this->at(a);
  const Position to = this->at(b);
  // Flat and clockwise triangles are faults of their own.
  return turn(from, to, this->at(left)) > 0 && turn(to, from, this->at(right)) > 0 &&
    breaksDelaunay(from, to, this->at(left), this->at(right), tieRule);
}

std::vector<std::int64_t> MeshEdges::borderVertices() const
{
  std::vector<std::int64_t> vertices;
  this->visitBorder(
    [&vertices](std::int64_t from, std::int64_t to)
    {
      vertices.push_back(from);
      vertices.push_back(to);
    });
  std::sort(vertices.begin(), vertices.end(),
    [this](std::int64_t a, std::int64_t b)
    { return this->isBeforeAt(a, b) || (!this->isBeforeAt(b, a) && a < b); });
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

bool MeshEdges::entersMesh(std::int64_t vertex, Position to) const
{
  const Position from = this->at(vertex);
  for (std::size_t i = this->firstFrom(vertex); this->isFrom(i, vertex); ++i)
  {
    const Position p = this->at(this->Edges[i].To);
    const int side = turn(from, p, to);
    const bool isAlong = side == 0 && isBefore(from, p) == isBefore(from, to);
    const std::int64_t left = this->Edges[i].Left;
    if (isAlong || (side > 0 && left != None && turn(from, to, this->at(left)) > 0))
    {
      return true;
    }
  }
  return false;
}

} // namespace check
} // namespace tipp
