// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellVisitor_h
#define tippCellVisitor_h

#include "Parallel/Instructions.h"
#include "Parallel/ParallelFor.h"
#include "Resample/CellLanes.h"
#include "Resample/CellRows.h"
#include "Resample/Claims.h"
#include "Resample/GroupBoxes.h"
#include "Resample/Lattice.h"
#include "Resample/SamplingAccess.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace tipp
{

/// Visits the samples of all cells; each thread has its own sink. It calls sink.visit(samples) for
/// each cell whose box has samples, with their number; sink.claim(row, begin, count, cell) for the
/// samples of a row that a cell claims (none if count <= 0); sink.touch(row, begin, count, cell)
/// for those on a cell's border that it does not claim; sink.addExactTests(count); and
/// sink.endChunk() now and then.
template <typename Access, typename Sink>
class CellVisitor
{
public:
  CellVisitor(const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Sink>& sinks)
    : Mesh(mesh)
    , Cells(mesh)
    , Axes(axes)
    , Outside(mesh, axes)
    , Sinks(sinks)
    , Large(sinks.size())
  {
  }

  /// Returns false if `report` stopped it.
  bool run(const Report& report)
  {
    constexpr std::int64_t chunk = 64 * GroupBoxes::Size;
    if (Dimension == 2)
    {
      this->Groups.reset(this->Mesh.Cells);
    }
    this->Outside.find(int(this->Sinks.size()));
    const auto visit = [this](std::int64_t begin, std::int64_t end, int thread)
    { runWith(Instructions::Best, [&] { this->visitChunk(begin, end, thread); }); };
    return forChunks(this->Mesh.Cells, chunk, int(this->Sinks.size()), report, visit) &&
      this->visitLargeCells(report);
  }

  /// The boxes of triangles, after run().
  GroupBoxes& boxes() { return this->Groups; }

private:
  static constexpr int Dimension = Access::Dimension;
  using Rows = CellRows<Dimension>;
  using FourCells = CellLanes<Dimension>;
  using Corners = typename Access::Point[Access::Corners];

  /// Cells with more samples are split among the threads, in parts of about this many samples.
  static constexpr std::int64_t LargeCell = 1 << 16;
  static constexpr std::int64_t LargePart = 1 << 14;
  /// Number of cells whose points are prefetched together, unless the cells are outside.
  static constexpr std::int64_t Ahead = 32;

  struct Part
  {
    std::int32_t Cell;
    std::int64_t RowBegin; ///< relative to the first row of the cell's first layer
    std::int64_t RowEnd;
  };

  [[gnu::always_inline]] void visitChunk(std::int64_t begin, std::int64_t end, int thread)
  {
    Sink& sink = this->Sinks[std::size_t(thread)];
    Rows rows(this->Axes);
    FourCells lanes(this->Axes);
    BoxLanes box;
    bool outside[2 * Ahead] = {};
    std::int64_t cell = begin;
    for (; cell + laneCount <= end; cell += laneCount)
    {
      if ((cell - begin) % Ahead == 0)
      {
        this->prefetch(
          cell == begin ? cell : cell + Ahead, std::min(cell + 2 * Ahead, end), outside);
      }
      const bool* const without = outside + cell % (2 * Ahead);
      if (without[0] && without[1] && without[2] && without[3])
      {
        box.addUnknown();
        this->endGroup(cell + laneCount, box);
        continue;
      }
      lanes.set(this->Cells, cell);
      if constexpr (Dimension == 2)
      {
        box.add(lanes.columns(), lanes.rows());
        this->endGroup(cell + laneCount, box);
      }
      if (lanes.nothing())
      {
        continue;
      }
      if constexpr (Dimension == 3)
      {
        if (lanes.haveSingleSamples())
        {
          this->visitSingleSamples(lanes, cell, rows, thread);
          continue;
        }
        if (!this->Mesh.Hidden && lanes.haveSingleRows())
        {
          this->visitSingleRows(lanes, cell, rows, sink);
          continue;
        }
      }
      lanes.prepareRows();
      for (int lane = 0; lane < laneCount; ++lane)
      {
        if (!lanes.nothing(lane) && !this->hidden(cell + lane))
        {
          if (!(lanes.fast(lane) && this->visitLane(lanes, lane, cell + lane, rows, sink)))
          {
            this->visitCell(cell + lane, rows, thread);
          }
        }
      }
    }
    for (; cell < end; ++cell)
    {
      if (!this->hidden(cell))
      {
        this->visitCell(cell, rows, thread);
      }
    }
    sink.addExactTests(rows.exactTests());
    sink.endChunk();
  }

  /// Stores the box of a group that ends before cell `end`; others are not complete.
  [[gnu::always_inline]] void endGroup(std::int64_t end, BoxLanes& box)
  {
    if (Dimension == 2 && end % GroupBoxes::Size == 0)
    {
      this->Groups.set(end / GroupBoxes::Size - 1, box.box());
      box = BoxLanes();
    }
  }

  bool hidden(std::int64_t cell) const { return this->Mesh.Hidden && this->Mesh.Hidden[cell] != 0; }

  /// A bit mask of the hidden cells from `first` on.
  unsigned hiddenLanes(std::int64_t first) const
  {
    unsigned hidden = 0;
    for (int lane = 0; this->Mesh.Hidden && lane < laneCount; ++lane)
    {
      hidden |= unsigned(this->hidden(first + lane)) << lane;
    }
    return hidden;
  }

  /// Visits one of four cells. Returns false, without visiting it, if the cell is large.
  [[gnu::always_inline]] bool visitLane(
    const FourCells& lanes, int lane, std::int64_t cell, Rows& rows, Sink& sink)
  {
    const IndexRange across = lanes.rows(lane);
    const IndexRange layers = lanes.layers(lane);
    const std::int64_t samples =
      std::int64_t(lanes.columns(lane).size()) * across.size() * layers.size();
    if (samples > LargeCell)
    {
      return false;
    }
    sink.visit(samples);
    const int rowCount = across.size() * layers.size();
    for (int first = 0; first < rowCount;)
    {
      const auto spans = lanes.spans(lane, first);
      const int next = first + int(std::size(spans.Row));
      if (spans.Doubtful != 0)
      {
        this->visitExactly({ std::int32_t(cell), first, std::min(next, rowCount) }, rows, sink);
        first = next;
        continue;
      }
      for (unsigned open = spans.Open; open != 0; open &= open - 1)
      {
        const int i = __builtin_ctz(open);
        sink.claim(this->sampleRow(spans.Row[i], spans.Layer[i]), spans.Begin[i], spans.Size[i],
          std::int32_t(cell));
      }
      first = next;
    }
    return true;
  }

  /// A fast path: most tetrahedra that are small compared with the spacing have at most one row of
  /// samples.
  [[gnu::always_inline]] void visitSingleRows(
    const FourCells& lanes, std::int64_t first, Rows& rows, Sink& sink)
  {
    const auto spans = lanes.singleRows();
    for (int lane = 0; lane < laneCount; ++lane)
    {
      if (!lanes.nothing(lane))
      {
        sink.visit(lanes.columns(lane).size());
      }
    }
    for (unsigned open = spans.Open; open != 0; open &= open - 1)
    {
      const int lane = __builtin_ctz(open);
      const std::int32_t cell = std::int32_t(first + lane);
      if ((spans.Doubtful >> lane & 1) != 0)
      {
        this->visitExactly({ cell, 0, 1 }, rows, sink);
        continue;
      }
      sink.claim(this->sampleRow(spans.Row[lane], spans.Layer[lane]), spans.Begin[lane],
        spans.Size[lane], cell);
    }
  }

  /// A fast path: if the spacing is about the size of the tetrahedra, most boxes have one sample.
  [[gnu::always_inline]] void visitSingleSamples(
    const FourCells& lanes, std::int64_t first, Rows& rows, int thread)
  {
    Sink& sink = this->Sinks[std::size_t(thread)];
    const auto& spans = lanes.samples();
    const unsigned visited = lanes.visited() & ~this->hiddenLanes(first);
    for (unsigned decided = visited & ~spans.Doubtful; decided != 0; decided &= decided - 1)
    {
      sink.visit(1);
    }
    for (unsigned open = spans.Open & visited; open != 0; open &= open - 1)
    {
      const int lane = __builtin_ctz(open);
      if ((spans.Doubtful >> lane & 1) != 0)
      {
        this->visitCell(first + lane, rows, thread);
        continue;
      }
      sink.claim(this->sampleRow(spans.Row[lane], spans.Layer[lane]), spans.Begin[lane], 1,
        std::int32_t(first + lane));
    }
  }

  [[gnu::noinline]] void visitExactly(const Part& part, Rows& rows, Sink& sink)
  {
    Corners corners;
    this->Cells.corners(part.Cell, corners);
    rows.set(corners);
    this->visitRows(rows, part, sink);
  }

  [[gnu::noinline]] void visitCell(std::int64_t cell, Rows& rows, int thread)
  {
    Sink& sink = this->Sinks[std::size_t(thread)];
    Corners corners;
    this->Cells.corners(cell, corners);
    if (!rows.set(corners))
    {
      return;
    }
    const Part part{ std::int32_t(cell), 0,
      std::int64_t(rows.rows().size()) * rows.layers().size() };
    const std::int64_t samples = part.RowEnd * rows.columns().size();
    sink.visit(samples);
    samples > LargeCell ? this->defer(rows, part, thread) : this->visitRows(rows, part, sink);
  }

  /// Finds which of the cells are outside, and prefetches the points of the others.
  [[gnu::always_inline]] void prefetch(
    std::int64_t begin, std::int64_t end, bool (&outside)[2 * Ahead]) const
  {
    for (std::int64_t cell = begin; cell < end; ++cell)
    {
      outside[cell % (2 * Ahead)] = this->Outside.contain(cell);
      if (!outside[cell % (2 * Ahead)])
      {
        this->Cells.prefetch(cell);
      }
    }
  }

  SampleRow sampleRow(int row, int layer) const
  {
    const std::int64_t line = std::int64_t(layer) * this->Axes.V.size() + row;
    return { line * this->Axes.U.size(), row, layer };
  }

  void visitRows(const Rows& rows, const Part& part, Sink& sink)
  {
    int row = rows.rows().Begin;
    int layer = rows.layers().Begin;
    if (part.RowBegin > 0)
    {
      row += int(part.RowBegin % rows.rows().size());
      layer += int(part.RowBegin / rows.rows().size());
    }
    for (std::int64_t i = part.RowBegin; i < part.RowEnd; ++i)
    {
      const RowSpan span = rows.span(row, layer);
      const SampleRow samples = this->sampleRow(row, layer);
      sink.claim(samples, span.Begin, span.End - span.Begin, part.Cell);
      const int border = std::max(span.Begin, span.End);
      if (span.ClosedEnd > border)
      {
        sink.touch(samples, border, span.ClosedEnd - border, part.Cell);
      }
      if (++row == rows.rows().End)
      {
        row = rows.rows().Begin;
        ++layer;
      }
    }
  }

  void defer(const Rows& rows, const Part& whole, int thread)
  {
    const std::int64_t step = std::max<std::int64_t>(1, LargePart / rows.columns().size());
    for (std::int64_t begin = 0; begin < whole.RowEnd; begin += step)
    {
      this->Large[std::size_t(thread)].push_back(
        { whole.Cell, begin, std::min(begin + step, whole.RowEnd) });
    }
  }

  bool visitLargeCells(const Report& report)
  {
    std::vector<Part> parts;
    for (std::vector<Part>& large : this->Large)
    {
      parts.insert(parts.end(), large.begin(), large.end());
      large = {};
    }
    const auto visit = [&](std::int64_t i, std::int64_t, int thread)
    {
      Sink& sink = this->Sinks[std::size_t(thread)];
      Rows rows(this->Axes);
      this->visitExactly(parts[std::size_t(i)], rows, sink);
      sink.addExactTests(rows.exactTests());
      sink.endChunk();
    };
    return forChunks(std::int64_t(parts.size()), 1, int(this->Sinks.size()), report, visit);
  }

  const SimplexMesh& Mesh;
  Access Cells;
  const LatticeAxes& Axes;
  OutsidePoints<Access> Outside;
  std::vector<Sink>& Sinks;
  std::vector<std::vector<Part>> Large;
  GroupBoxes Groups;
};

/// Runs a CellVisitor over the mesh. Sets `boxes` to its boxes.
template <typename Sink>
bool visitCells(const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Sink>& sinks,
  const Report& report, GroupBoxes& boxes)
{
  bool completed = false;
  withSamplingAccess(mesh,
    [&](const auto& access)
    {
      using Access = std::decay_t<decltype(access)>;
      CellVisitor<Access, Sink> visitor(mesh, axes, sinks);
      completed = visitor.run(report);
      boxes = std::move(visitor.boxes());
    });
  return completed;
}

/// The common base of the sinks that find the cells of samples: statistics, and the touches whose
/// samples no cell has claimed yet. `Walk::isClaimed(sample)` returns whether a cell has claimed a
/// sample.
template <typename Walk>
class TouchingWalk
{
public:
  void visit(std::int64_t samples)
  {
    ++this->Statistics.VisitedCells;
    this->Statistics.Tests += samples;
  }
  void addExactTests(std::int64_t count) { this->Statistics.ExactTests += count; }

  void touch(const SampleRow& row, int begin, int count, std::int32_t cell)
  {
    for (std::int64_t i = row.First + begin; i < row.First + begin + count; ++i)
    {
      if (!this->isClaimed(i))
      {
        this->Touches.push_back({ i, cell });
      }
    }
  }

  /// Saves memory: now and then removes the touches of samples that have been claimed meanwhile.
  void endChunk()
  {
    if (this->Touches.size() > this->MostTouches)
    {
      this->MostTouches = std::max(this->MostTouches, 2 * this->openTouches().size());
    }
  }

  /// The touches of samples that no cell has claimed.
  const std::vector<Touch>& openTouches()
  {
    this->Touches.erase(std::remove_if(this->Touches.begin(), this->Touches.end(),
                          [this](const Touch& touch) { return this->isClaimed(touch.Sample); }),
      this->Touches.end());
    return this->Touches;
  }

  ClaimStatistics Statistics;
  std::int64_t Claimed = 0; ///< number of samples, each counted for every cell that claims it

private:
  bool isClaimed(std::int64_t sample) const
  {
    return static_cast<const Walk*>(this)->isClaimed(sample);
  }

  std::vector<Touch> Touches;
  std::size_t MostTouches = 1 << 16;
};

/// Adds up what the threads' walks have found. Returns the touches of samples that no cell has
/// claimed.
template <typename Walk>
std::vector<Touch> joinWalks(
  std::vector<Walk>& walks, ClaimStatistics& statistics, std::int64_t& claimed)
{
  std::vector<Touch> touches;
  for (Walk& walk : walks)
  {
    statistics.VisitedCells += walk.Statistics.VisitedCells;
    statistics.Tests += walk.Statistics.Tests;
    statistics.ExactTests += walk.Statistics.ExactTests;
    claimed += walk.Claimed;
    const std::vector<Touch>& open = walk.openTouches();
    touches.insert(touches.end(), open.begin(), open.end());
  }
  return touches;
}

/// The moveRank() of a cell at a sample that it touches.
template <typename Access>
int borderRank(
  const Access& access, const LatticeAxes& axes, std::int64_t sample, std::int32_t cell)
{
  typename Access::Point corners[Access::Corners];
  access.corners(cell, corners);
  const std::int64_t row = sample / axes.U.size();
  const double u = axes.U[int(sample % axes.U.size())];
  const double v = axes.V[int(row % axes.V.size())];
  if constexpr (Access::Dimension == 2)
  {
    return moveRank(corners, { u, v });
  }
  else
  {
    return moveRank(corners, { u, v, axes.W[int(row / axes.V.size())] });
  }
}

} // namespace tipp

#endif
