// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintEdges.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace tipp
{

std::vector<IdSegment> segmentsOf(
  const std::vector<IdSegment>& segments, std::size_t begin, std::size_t end)
{
  std::vector<IdSegment> some;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(some),
    [begin, end](const IdSegment& segment)
    { return std::size_t(segment.Constraint) >= begin && std::size_t(segment.Constraint) < end; });
  return some;
}

ConstraintEdges::ConstraintEdges(const std::vector<IdSegment>& segments)
{
  constexpr std::size_t most = std::size_t(1) << 22; // fits into caches
  std::size_t marks = 1;
  while (marks < most && marks < 8 * segments.size())
  {
    marks *= 2;
  }
  this->IsLower.assign(marks, 0);
  this->Edges.reserve(segments.size());
  for (const IdSegment& segment : segments)
  {
    const Ends ends = std::minmax(segment.A, segment.B);
    this->Edges.push_back({ ends, segment.A < segment.B ? 1 : -1 });
    this->IsLower[std::size_t(ends.first) % marks] = 1;
  }
  std::sort(this->Edges.begin(), this->Edges.end(),
    [](const Edge& a, const Edge& b) { return a.Ids < b.Ids; });
}

std::pair<ConstraintEdges::Iterator, ConstraintEdges::Iterator> ConstraintEdges::between(
  PointId a, PointId b) const
{
  const Ends ends = std::minmax(a, b);
  const Iterator end = this->Edges.end();
  if (this->IsLower[std::size_t(ends.first) % this->IsLower.size()] == 0)
  {
    return { end, end };
  }
  const Iterator first = std::lower_bound(this->Edges.begin(), end, ends,
    [](const Edge& edge, const Ends& wanted) { return edge.Ids < wanted; });
  return { first,
    std::find_if(first, end, [&ends](const Edge& edge) { return edge.Ids != ends; }) };
}

int ConstraintEdges::balance(PointId a, PointId b) const
{
  const auto [begin, end] = this->between(a, b);
  const int ascending =
    std::accumulate(begin, end, 0, [](int sum, const Edge& edge) { return sum + edge.Direction; });
  return a < b ? ascending : -ascending;
}

int ConstraintEdges::count(PointId a, PointId b) const
{
  const auto [begin, end] = this->between(a, b);
  return int(end - begin);
}

} // namespace tipp
