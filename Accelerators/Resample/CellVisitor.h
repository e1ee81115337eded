// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellVisitor_h
#define tippCellVisitor_h

#include "Parallel/ForChunks.h"
#include "Resample/LatticeAxis.h"
#include "Resample/SimplexMesh.h"
#include "Resample/TetrahedronRows.h"
#include "Resample/TriangleRows.h"

#include <cstdint>
#include <vector>

namespace tipp
{

template <int Dimension>
struct CellGeometry;

template <>
struct CellGeometry<2>
{
  using Corners = Point2[3];
  using Rows = TriangleRows;
};

template <>
struct CellGeometry<3>
{
  using Corners = Point3[4];
  using Rows = TetrahedronRows;
};

/// The axes of a lattice that a mesh's samples lie on.
struct LatticeAxes
{
  LatticeAxes(const SimplexMesh& mesh, const Lattice& lattice)
    : U(lattice, mesh.Dimension == 2 ? mesh.Axes[0] : 0)
    , V(lattice, mesh.Dimension == 2 ? mesh.Axes[1] : 1)
    , W(lattice, 2)
    , Layers(mesh.Dimension == 2 ? 1 : W.size())
  {
  }

  std::int64_t samples() const { return std::int64_t(U.size()) * V.size() * Layers; }

  TriangleRows rows(std::integral_constant<int, 2>) const { return { U, V }; }
  TetrahedronRows rows(std::integral_constant<int, 3>) const { return { U, V, W }; }

  LatticeAxis U;
  LatticeAxis V;
  LatticeAxis W;
  int Layers;
};

/// Walks over the samples of all cells, each thread with a sink of its own:
/// sink.visit(samples) for each cell whose box has samples, with their number;
/// sink.claim(first, count, cell) for samples in a row that a cell answers;
/// sink.touch(first, count, cell) for those on a cell's border that it does not answer;
/// sink.addExactTests(count); sink.endChunk() now and then.
template <typename Access, typename Sink>
class CellVisitor
{
public:
  CellVisitor(const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Sink>& sinks)
    : Mesh(mesh)
    , Cells(mesh)
    , Axes(axes)
    , Sinks(sinks)
    , Large(sinks.size())
  {
  }

  /// False if `report` stopped it.
  bool run(const Report& report)
  {
    constexpr std::int64_t chunk = 4096;
    const auto visit = [this](std::int64_t begin, std::int64_t end, int thread)
    { this->visitChunk(nullptr, begin, end, thread); };
    return forChunks(this->Mesh.Cells, chunk, int(this->Sinks.size()), report, visit) &&
      this->visitLargeCells(report);
  }

private:
  static constexpr int Dimension = Access::Dimension;
  using Rows = typename CellGeometry<Dimension>::Rows;
  using Corners = typename CellGeometry<Dimension>::Corners;

  /// Cells of more samples are shared out among the threads, in parts of about so many samples.
  static constexpr std::int64_t LargeCell = 1 << 16;
  static constexpr std::int64_t LargePart = 1 << 14;
  /// Cells whose points are asked for before they are used.
  static constexpr std::int64_t Ahead = 12;

  struct Part
  {
    std::int32_t Cell;
    std::int64_t RowBegin; ///< counted from the first of the cell's first layer
    std::int64_t RowEnd;
  };

  Rows makeRows() const { return this->Axes.rows(std::integral_constant<int, Dimension>()); }

  /// Cells begin..end - 1; or those parts of large cells.
  void visitChunk(const Part* parts, std::int64_t begin, std::int64_t end, int thread)
  {
    Sink& sink = this->Sinks[std::size_t(thread)];
    Rows rows = this->makeRows();
    Corners corners;
    for (std::int64_t i = begin; i < end; ++i)
    {
      const std::int64_t cell = parts ? parts[i].Cell : i;
      this->Cells.prefetch(std::min(cell + Ahead, this->Mesh.Cells - 1));
      if (this->Mesh.Hidden && this->Mesh.Hidden[cell])
      {
        continue;
      }
      this->Cells.corners(cell, corners);
      if (!rows.set(corners))
      {
        continue;
      }
      const std::int64_t samples = samplesOf(rows);
      Part part{ std::int32_t(cell), 0, rowsOf(rows) };
      if (parts)
      {
        part = parts[i];
      }
      else
      {
        sink.visit(samples);
        if (samples > LargeCell)
        {
          this->defer(rows, part, thread);
          continue;
        }
      }
      this->visitRows(rows, part, sink);
    }
    sink.addExactTests(rows.exactTests());
    sink.endChunk();
  }

  static std::int64_t samplesOf(const Rows& rows)
  {
    return std::int64_t(rows.columns().size()) * rows.rows().size() * rows.layers().size();
  }

  static std::int64_t rowsOf(const Rows& rows)
  {
    return std::int64_t(rows.rows().size()) * rows.layers().size();
  }

  [[gnu::always_inline]] void visitRows(const Rows& rows, const Part& part, Sink& sink)
  {
    const std::int64_t width = this->Axes.U.size();
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
      const std::int64_t first = (std::int64_t(layer) * this->Axes.V.size() + row) * width;
      if (span.End > span.Begin)
      {
        sink.claim(first + span.Begin, span.End - span.Begin, part.Cell);
      }
      const int border = std::max(span.Begin, span.End);
      if (span.ClosedEnd > border)
      {
        sink.touch(first + border, span.ClosedEnd - border, part.Cell);
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
    const auto visit = [&](std::int64_t begin, std::int64_t end, int thread)
    { this->visitChunk(parts.data(), begin, end, thread); };
    return forChunks(std::int64_t(parts.size()), 1, int(this->Sinks.size()), report, visit);
  }

  const SimplexMesh& Mesh;
  Access Cells;
  const LatticeAxes& Axes;
  std::vector<Sink>& Sinks;
  std::vector<std::vector<Part>> Large;
};

/// Runs a CellVisitor over the mesh.
template <typename Sink>
bool visitCells(
  const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Sink>& sinks, const Report& report)
{
  bool completed = false;
  withAccess(mesh,
    [&](const auto& access)
    {
      using Access = std::decay_t<decltype(access)>;
      completed = CellVisitor<Access, Sink>(mesh, axes, sinks).run(report);
    });
  return completed;
}

} // namespace tipp

#endif
