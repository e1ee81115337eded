// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Constraint.h"

#include <algorithm>
#include <iterator>

namespace tipp
{

std::vector<ConstraintPiece> piecesOf(
  const std::vector<ConstraintPiece>& pieces, std::size_t begin, std::size_t end)
{
  std::vector<ConstraintPiece> some;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(some),
    [begin, end](const ConstraintPiece& piece)
    { return std::size_t(piece.Constraint) >= begin && std::size_t(piece.Constraint) < end; });
  return some;
}

ConstraintEdges::ConstraintEdges(const std::vector<ConstraintPiece>& pieces)
{
  constexpr std::size_t most = std::size_t(1) << 22; // fits into caches
  std::size_t marks = 1;
  while (marks < most && marks < 8 * pieces.size())
  {
    marks *= 2;
  }
  this->IsLower.assign(marks, 0);
  this->Edges.reserve(pieces.size());
  for (const ConstraintPiece& piece : pieces)
  {
    const Ends ends = std::minmax(piece.A, piece.B);
    this->Edges.push_back({ ends, piece.A < piece.B ? 1 : -1 });
    this->IsLower[std::size_t(ends.first) % marks] = 1;
  }
  std::sort(this->Edges.begin(), this->Edges.end(),
    [](const Edge& a, const Edge& b) { return a.Ids < b.Ids; });
}

std::vector<ConstraintEdges::Edge>::const_iterator ConstraintEdges::find(const Ends& ends) const
{
  const auto found = std::lower_bound(this->Edges.begin(), this->Edges.end(), ends,
    [](const Edge& edge, const Ends& wanted) { return edge.Ids < wanted; });
  return found != this->Edges.end() && found->Ids == ends ? found : this->Edges.end();
}

bool ConstraintEdges::contains(PointId a, PointId b) const
{
  const Ends ends = std::minmax(a, b);
  return this->mayContain(ends.first) && this->find(ends) != this->Edges.end();
}

int ConstraintEdges::balance(PointId a, PointId b) const
{
  const Ends ends = std::minmax(a, b);
  int sum = 0;
  if (this->mayContain(ends.first))
  {
    for (auto edge = this->find(ends); edge != this->Edges.end() && edge->Ids == ends; ++edge)
    {
      sum += edge->Direction;
    }
  }
  return a < b ? sum : -sum;
}

int ConstraintEdges::count(PointId a, PointId b) const
{
  const Ends ends = std::minmax(a, b);
  int sum = 0;
  if (this->mayContain(ends.first))
  {
    for (auto edge = this->find(ends); edge != this->Edges.end() && edge->Ids == ends; ++edge)
    {
      ++sum;
    }
  }
  return sum;
}

} // namespace tipp
