// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/CellCounter.h"

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

struct MeasuredCell
{
  const double* Corners;
  Box3 Bounds;
  double Length;
};

bool measure(const CellShape& shape, int dimension, std::size_t index, MeasuredCell& cell)
{
  cell.Corners = shape.cell(index);
  const bool finite = shape.bounds(cell.Corners, cell.Bounds);
  cell.Length = 0.0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
  {
    cell.Length = std::max(cell.Length, cell.Bounds.Max[axis] - cell.Bounds.Min[axis]);
  }
  return finite;
}

bool boundsMeet(const Box3& a, const Box3& b)
{
  return a.Min[0] <= b.Max[0] && b.Min[0] <= a.Max[0] && a.Min[1] <= b.Max[1] &&
    b.Min[1] <= a.Max[1] && a.Min[2] <= b.Max[2] && b.Min[2] <= a.Max[2];
}

bool isWithin(const Box3& a, const Box3& b)
{
  return b.Min[0] <= a.Min[0] && a.Max[0] <= b.Max[0] && b.Min[1] <= a.Min[1] &&
    a.Max[1] <= b.Max[1] && b.Min[2] <= a.Min[2] && a.Max[2] <= b.Max[2];
}

} // namespace

// A thread's counts, and the visits that it records.
struct CellCounter::ThreadRange
{
  std::size_t Begin;
  std::size_t End;
  NodeCounts Counts;
  std::vector<Visit> Visits;
};

CellCounter::CellCounter(RefinementTree& tree, int maxDepth, int threads)
  : Tree(tree)
  , MaxDepth(maxDepth)
  , Threads(threadCount(threads))
{
}

void CellCounter::add(const CellsView& chunk, std::int64_t firstCell, std::int64_t limit)
{
  const CellShape shape(chunk, this->Tree.dimension());
  this->countAll(shape, chunk.Cells, firstCell);
  if (!this->markSplits(limit))
  {
    return;
  }
  this->collectVisits(shape, chunk.Cells);
  const std::size_t most =
    std::max(std::size_t(1) << 17, 8 * (static_cast<std::size_t>(firstCell) + chunk.Cells));
  do
  {
    if (this->Tree.size() > most)
    {
      throw IOError("More than " + std::to_string(limit) +
        " cells overlap nearly everywhere, so that no " +
        "boxes hold fewer; allow more cells a box.");
    }
    this->refineOnce(shape);
  } while (this->markSplits(limit));
  this->Visits.clear();
}

std::vector<CellCounter::ThreadRange> CellCounter::makeRanges(std::size_t items) const
{
  const auto count = static_cast<std::size_t>(this->Threads);
  std::vector<ThreadRange> ranges(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    ranges[i].Begin = items * i / count;
    ranges[i].End = items * (i + 1) / count;
    ranges[i].Counts.resize(this->Tree.size());
  }
  return ranges;
}

void CellCounter::sum(const std::vector<ThreadRange>& ranges)
{
  this->Counts.resize(this->Tree.size());
  for (const ThreadRange& range : ranges)
  {
    for (std::size_t node = 0; node < this->Tree.size(); ++node)
    {
      this->Counts.Meeting[node] += range.Counts.Meeting[node];
      this->Counts.Fitting[node] += range.Counts.Fitting[node];
    }
  }
}

void CellCounter::countAll(const CellShape& shape, std::size_t cells, std::int64_t firstCell)
{
  this->Marked.clear();
  std::vector<ThreadRange> ranges = this->makeRanges(cells);
  parallelFor(this->Threads, this->Threads,
    [&](std::int64_t s)
    {
      ThreadRange& range = ranges[static_cast<std::size_t>(s)];
      MeasuredCell measured;
      for (std::size_t i = range.Begin; i < range.End; ++i)
      {
        pollAt(std::int64_t(i));
        const bool finite = measure(shape, this->Tree.dimension(), i, measured);
        if (!finite ||
          (!isWithin(measured.Bounds, this->Tree.domain()) &&
            !shape.meets(measured.Corners, this->Tree.domain())))
        {
          throw IOError("Cell " + std::to_string(firstCell + static_cast<std::int64_t>(i)) +
            (finite ? " lies outside the domain that is partitioned."
                    : " has a corner whose coordinates are not finite."));
        }
        this->visitTree(shape, static_cast<std::uint32_t>(i), range);
      }
    });
  this->sum(ranges);
}

// Counts the cell in all nodes that it meets. If leaves are marked, records visits to these only.
void CellCounter::visitTree(
  const CellShape& shape, std::uint32_t cellIndex, ThreadRange& range) const
{
  MeasuredCell cell;
  measure(shape, this->Tree.dimension(), cellIndex, cell);
  std::array<std::int32_t, 7 * BoxTiling::MaxDepth + 1> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0)
  {
    const std::int32_t node = stack[--size];
    const auto index = static_cast<std::size_t>(node);
    if (this->Marked.empty())
    {
      ++range.Counts.Meeting[index];
      range.Counts.Fitting[index] += cell.Length <= this->Tree.length(node) ? 1 : 0;
    }
    else if (this->Marked[index] != 0)
    {
      range.Visits.push_back({ node, cellIndex });
    }
    if (this->Tree.isLeaf(node))
    {
      continue;
    }
    for (std::int32_t child = this->Tree.firstChild(node), end = child + this->Tree.childCount();
         child < end; ++child)
    {
      const Box3& box = this->Tree.box(child);
      if (boundsMeet(cell.Bounds, box) &&
        (isWithin(cell.Bounds, box) || shape.meets(cell.Corners, box)))
      {
        stack[size++] = child;
      }
    }
  }
}

void CellCounter::visitChildren(const CellShape& shape, Visit parent, ThreadRange& range) const
{
  MeasuredCell cell;
  measure(shape, this->Tree.dimension(), parent.Cell, cell);
  const std::int32_t first = this->Tree.firstChild(parent.Node);
  for (std::int32_t child = first; child < first + this->Tree.childCount(); ++child)
  {
    const Box3& box = this->Tree.box(child);
    if (boundsMeet(cell.Bounds, box) &&
      (isWithin(cell.Bounds, box) || shape.meets(cell.Corners, box)))
    {
      const auto index = static_cast<std::size_t>(child);
      ++range.Counts.Meeting[index];
      range.Counts.Fitting[index] += cell.Length <= this->Tree.length(child) ? 1 : 0;
      range.Visits.push_back({ child, parent.Cell });
    }
  }
}

bool CellCounter::markSplits(std::int64_t limit)
{
  this->Marked.assign(this->Tree.size(), 0);
  bool any = false;
  for (std::size_t index = 0; index < this->Tree.size(); ++index)
  {
    const auto node = static_cast<std::int32_t>(index);
    if (this->Counts.Fitting[index] > limit && this->Tree.isLeaf(node) &&
      this->Tree.canSplit(node, this->MaxDepth))
    {
      this->Marked[index] = 1;
      any = true;
    }
  }
  return any;
}

void CellCounter::collectVisits(const CellShape& shape, std::size_t cells)
{
  std::vector<ThreadRange> ranges = this->makeRanges(cells);
  parallelFor(this->Threads, this->Threads,
    [&](std::int64_t s)
    {
      ThreadRange& range = ranges[static_cast<std::size_t>(s)];
      for (std::size_t i = range.Begin; i < range.End; ++i)
      {
        pollAt(std::int64_t(i));
        this->visitTree(shape, static_cast<std::uint32_t>(i), range);
      }
    });
  this->takeVisits(ranges);
}

// Splits the marked leaves and counts the cells that visited them in their children.
void CellCounter::refineOnce(const CellShape& shape)
{
  for (std::size_t index = 0, end = this->Tree.size(); index < end; ++index)
  {
    if (this->Marked[index] != 0)
    {
      this->Tree.split(static_cast<std::int32_t>(index));
    }
  }
  const std::vector<Visit> parents = std::move(this->Visits);
  std::vector<ThreadRange> ranges = this->makeRanges(parents.size());
  parallelFor(this->Threads, this->Threads,
    [&](std::int64_t s)
    {
      ThreadRange& range = ranges[static_cast<std::size_t>(s)];
      for (std::size_t i = range.Begin; i < range.End; ++i)
      {
        pollAt(std::int64_t(i));
        if (this->Marked[static_cast<std::size_t>(parents[i].Node)] != 0)
        {
          this->visitChildren(shape, parents[i], range);
        }
      }
    });
  this->sum(ranges);
  this->takeVisits(ranges);
}

void CellCounter::takeVisits(std::vector<ThreadRange>& ranges)
{
  this->Visits.clear();
  for (ThreadRange& range : ranges)
  {
    this->Visits.insert(this->Visits.end(), range.Visits.begin(), range.Visits.end());
    range.Visits = {};
  }
}

} // namespace tipp
