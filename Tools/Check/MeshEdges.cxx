// SPDX-License-Identifier: BSD-3-Clause
#include "Check/MeshEdges.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace tipp
{
namespace check
{

MeshEdges::MeshEdges(const std::vector<double>& xy, const std::vector<std::int64_t>& triangles)
  : XY(xy)
{
  if (std::uint64_t(this->points()) >= NoIndex)
  {
    throw std::length_error("A mesh of 2^32 points or more cannot be checked.");
  }
  this->addTriangles(triangles);
  this->sortEdges();
  this->addBorder();
  for (std::int64_t point = 0; point < this->points(); ++point)
  {
    if (this->Starts[std::size_t(point)] != this->Starts[std::size_t(point) + 1])
    {
      this->Vertices.push_back(Index(point));
    }
  }
  std::sort(this->Vertices.begin(), this->Vertices.end(),
    [this](Index a, Index b) { return this->isBeforeAt(a, b); });
}

/// Adds the edges of triangles as seen from their left, by their start: a counting sort.
void MeshEdges::addTriangles(const std::vector<std::int64_t>& triangles)
{
  const auto forEdges = [&](const auto& visit)
  {
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3)
    {
      const std::int64_t* const corners = &triangles[t];
      if (std::any_of(corners, corners + 3,
            [&](std::int64_t id)
            { return id < 0 || id >= this->points() || !isFinite(this->at(id)); }))
      {
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k)
      {
        visit(std::size_t(corners[k]),
          Edge{ Index(corners[(k + 1) % 3]), Index(corners[(k + 2) % 3]) });
      }
    }
  };
  // While edges are stored, entry i + 1 is where the next one from i is stored.
  this->Starts.assign(std::size_t(this->points()) + 2, 0);
  forEdges([this](std::size_t from, const Edge&) { ++this->Starts[from + 2]; });
  std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
  this->Edges.reserve(2 * this->Starts.back()); // untouched memory costs nothing
  this->Edges.resize(this->Starts.back());
  forEdges(
    [this](std::size_t from, const Edge& edge) { this->Edges[this->Starts[from + 1]++] = edge; });
}

/// Sorts the edges from each vertex by their end. Of repeated ones, which are faults, the one with
/// the highest corner is kept.
void MeshEdges::sortEdges()
{
  std::size_t end = 0;
  for (std::size_t point = 0; point < std::size_t(this->points()); ++point)
  {
    const auto first = this->Edges.begin() + std::ptrdiff_t(this->Starts[point]);
    const auto last = this->Edges.begin() + std::ptrdiff_t(this->Starts[point + 1]);
    std::sort(first, last,
      [](const Edge& a, const Edge& b) { return std::tie(a.To, b.Left) < std::tie(b.To, a.Left); });
    const auto kept =
      std::unique(first, last, [](const Edge& a, const Edge& b) { return a.To == b.To; });
    this->Starts[point] = end;
    end = std::size_t(
      std::copy(first, kept, this->Edges.begin() + std::ptrdiff_t(end)) - this->Edges.begin());
  }
  this->Starts[std::size_t(this->points())] = end;
  this->Edges.resize(end);
}

/// Adds the edges that have a triangle on their right only, from the last vertex to the first.
void MeshEdges::addBorder()
{
  std::vector<std::array<Index, 2>> added; // start and end
  this->allEdges(
    [&](std::int64_t from, std::int64_t to)
    {
      if (!this->find(to, from))
      {
        added.push_back({ Index(to), Index(from) });
      }
      return true;
    });
  std::sort(added.begin(), added.end());
  std::size_t end = this->Edges.size() + added.size();
  this->Edges.resize(end);
  const auto at = [this](std::size_t i) { return this->Edges.begin() + std::ptrdiff_t(i); };
  for (auto point = std::size_t(this->points()); point-- > 0;)
  {
    const std::size_t first = this->Starts[point];
    const std::size_t last = this->Starts[point + 1];
    this->Starts[point + 1] = end;
    auto begin = std::copy_backward(at(first), at(last), at(end));
    for (; !added.empty() && added.back()[0] == point; added.pop_back())
    {
      *--begin = { added.back()[1], NoIndex };
    }
    std::sort(begin, at(end), [](const Edge& a, const Edge& b) { return a.To < b.To; });
    end = std::size_t(begin - this->Edges.begin());
  }
}

/// Returns the edge, or null.
const MeshEdges::Edge* MeshEdges::find(std::int64_t from, std::int64_t to) const
{
  const EdgeRange edges = this->edgesFrom(from);
  const Edge* const found = std::find_if(
    edges.begin(), edges.end(), [to](const Edge& edge) { return std::int64_t(edge.To) == to; });
  return found == edges.end() ? nullptr : found;
}

std::int64_t MeshEdges::vertexAt(Position p) const
{
  const auto found = std::lower_bound(this->Vertices.begin(), this->Vertices.end(), p,
    [this](Index vertex, Position wanted) { return isBefore(this->at(vertex), wanted); });
  return found == this->Vertices.end() || isBefore(p, this->at(*found)) ? None
                                                                        : std::int64_t(*found);
}

std::int64_t MeshEdges::leftOf(std::int64_t from, std::int64_t to) const
{
  const Edge* const edge = this->find(from, to);
  return edge ? idOf(edge->Left) : None;
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
  for (const Edge& edge : this->edgesFrom(vertex))
  {
    const Position p = this->at(edge.To);
    const int side = turn(from, p, to);
    const bool isAlong = side == 0 && isBefore(from, p) == isBefore(from, to);
    const std::int64_t left = idOf(edge.Left);
    if (isAlong || (side > 0 && left != None && turn(from, to, this->at(left)) > 0))
    {
      return true;
    }
  }
  return false;
}

} // namespace check
} // namespace tipp
