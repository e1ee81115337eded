// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/TreeCounting.h"

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
struct TreeCounting::Stretch
{
  std::size_t Begin;
  std::size_t End;
  NodeCounts Counts;
  std::vector<Visit> Visits;
};

TreeCounting::TreeCounting(SplitTree& tree, int maxDepth, int threads)
  : Tree(tree)
  , MaxDepth(maxDepth)
  , Threads(threadCount(threads))
{
}

void TreeCounting::add(const CellsView& chunk, std::int64_t firstCell, std::int64_t limit)
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

std::vector<TreeCounting::Stretch> TreeCounting::makeStretches(std::size_t items) const
{
  const auto count = static_cast<std::size_t>(this->Threads);
  std::vector<Stretch> stretches(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    stretches[i].Begin = items * i / count;
    stretches[i].End = items * (i + 1) / count;
    stretches[i].Counts.resize(this->Tree.size());
  }
  return stretches;
}

void TreeCounting::sum(const std::vector<Stretch>& stretches)
{
  this->Counts.resize(this->Tree.size());
  for (const Stretch& stretch : stretches)
  {
    for (std::size_t node = 0; node < this->Tree.size(); ++node)
    {
      this->Counts.Meeting[node] += stretch.Counts.Meeting[node];
      this->Counts.Fitting[node] += stretch.Counts.Fitting[node];
    }
  }
}

void TreeCounting::countAll(const CellShape& shape, std::size_t cells, std::int64_t firstCell)
{
  this->Marked.clear();
  std::vector<Stretch> stretches = this->makeStretches(cells);
  parallelFor(this->Threads, this->Threads,
    [&](std::int64_t s)
    {
      Stretch& stretch = stretches[static_cast<std::size_t>(s)];
      MeasuredCell measured;
      for (std::size_t i = stretch.Begin; i < stretch.End; ++i)
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
        this->visitTree(shape, static_cast<std::uint32_t>(i), stretch);
      }
    });
  this->sum(stretches);
}

// Counts the cell in all nodes that it meets. If leaves are marked, records visits to these only.
void TreeCounting::visitTree(const CellShape& shape, std::uint32_t index, Stretch& stretch) const
{
  MeasuredCell cell;
  measure(shape, this->Tree.dimension(), index, cell);
  std::array<std::int32_t, 7 * BoxTiling::MaxDepth + 1> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0)
  {
    const std::int32_t node = stack[--size];
    const auto place = static_cast<std::size_t>(node);
    if (this->Marked.empty())
    {
      ++stretch.Counts.Meeting[place];
      stretch.Counts.Fitting[place] += cell.Length <= this->Tree.length(node) ? 1 : 0;
    }
    else if (this->Marked[place] != 0)
    {
      stretch.Visits.push_back({ node, index });
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

void TreeCounting::visitChildren(const CellShape& shape, Visit parent, Stretch& stretch) const
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
      const auto place = static_cast<std::size_t>(child);
      ++stretch.Counts.Meeting[place];
      stretch.Counts.Fitting[place] += cell.Length <= this->Tree.length(child) ? 1 : 0;
      stretch.Visits.push_back({ child, parent.Cell });
    }
  }
}

bool TreeCounting::markSplits(std::int64_t limit)
{
  this->Marked.assign(this->Tree.size(), 0);
  bool any = false;
  for (std::size_t place = 0; place < this->Tree.size(); ++place)
  {
    const auto node = static_cast<std::int32_t>(place);
    if (this->Counts.Fitting[place] > limit && this->Tree.isLeaf(node) &&
      this->Tree.canSplit(node, this->MaxDepth))
    {
      this->Marked[place] = 1;
      any = true;
    }
  }
  return any;
}

void TreeCounting::collectVisits(const CellShape& shape, std::size_t cells)
{
  std::vector<Stretch> stretches = this->makeStretches(cells);
  parallelFor(this->Threads, this->Threads,
    [&](std::int64_t s)
    {
      Stretch& stretch = stretches[static_cast<std::size_t>(s)];
      for (std::size_t i = stretch.Begin; i < stretch.End; ++i)
      {
        pollAt(std::int64_t(i));
        this->visitTree(shape, static_cast<std::uint32_t>(i), stretch);
      }
    });
  this->takeVisits(stretches);
}

// Splits the marked leaves and counts the cells that visited them in their children.
void TreeCounting::refineOnce(const CellShape& shape)
{
  for (std::size_t place = 0, end = this->Tree.size(); place < end; ++place)
  {
    if (this->Marked[place] != 0)
    {
      this->Tree.split(static_cast<std::int32_t>(place));
    }
  }
  const std::vector<Visit> parents = std::move(this->Visits);
  std::vector<Stretch> stretches = this->makeStretches(parents.size());
  parallelFor(this->Threads, this->Threads,
    [&](std::int64_t s)
    {
      Stretch& stretch = stretches[static_cast<std::size_t>(s)];
      for (std::size_t i = stretch.Begin; i < stretch.End; ++i)
      {
        pollAt(std::int64_t(i));
        if (this->Marked[static_cast<std::size_t>(parents[i].Node)] != 0)
        {
          this->visitChildren(shape, parents[i], stretch);
        }
      }
    });
  this->sum(stretches);
  this->takeVisits(stretches);
}

void TreeCounting::takeVisits(std::vector<Stretch>& stretches)
{
  this->Visits.clear();
  for (Stretch& stretch : stretches)
  {
    this->Visits.insert(this->Visits.end(), stretch.Visits.begin(), stretch.Visits.end());
    stretch.Visits = {};
  }
}

} // namespace tipp
