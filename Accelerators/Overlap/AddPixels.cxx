// SPDX-License-Identifier: BSD-3-Clause
#include "Overlap/AddOverlaps.h"
#include "Overlap/ConvexPart.h"
#include "Overlap/FieldIntegrals.h"
#include "Parallel/CountingSort.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// The borders of the pixels of a lattice along an axis: half way between the samples' coordinates.
/// Parts of a lattice have the very same borders.
class PixelBorders
{
public:
  PixelBorders(const Lattice& lattice, int axis)
    : Borders(std::size_t(lattice.size(axis)) + 1)
  {
    const GridSteps steps(lattice.Min[std::size_t(axis)], lattice.Delta[std::size_t(axis)]);
    for (std::size_t i = 0; i < this->Borders.size(); ++i)
    {
      const double next = double(lattice.Extent[std::size_t(2 * axis)]) + double(i);
      this->Borders[i] = steps[next - 1] + (steps[next] - steps[next - 1]) / 2;
    }
  }

  int size() const { return int(this->Borders.size()) - 1; }
  double operator[](int i) const { return this->Borders[std::size_t(i)]; }
  double width(int i) const { return (*this)[i + 1] - (*this)[i]; }
  double largest() const
  {
    return std::max(std::fabs(this->Borders.front()), std::fabs(this->Borders.back()));
  }

  /// The pixels whose interior meets the open interval ]low, high[: [first, second).
  std::pair<int, int> between(double low, double high) const
  {
    const auto begin = this->Borders.begin();
    const auto end = this->Borders.end();
    const auto first = std::upper_bound(begin, end, low) - begin - 1;
    const auto last = std::lower_bound(begin, end, high) - begin;
    return { int(std::max<std::ptrdiff_t>(first, 0)),
      int(std::min<std::ptrdiff_t>(last, this->size())) };
  }

private:
  std::vector<double> Borders;
};

/// Cuts triangles along rows and columns of pixels. Positions are relative to a corner of the
/// triangle, so that large coordinates cost no digits.
class PixelCutter
{
public:
  PixelCutter(const PixelBorders& columns, const PixelBorders& rows, bool isWeighted,
    const FieldIntegrals& fields, OverlapSums& sums)
    : Columns(columns)
    , Rows(rows)
    , Weights(isWeighted ? 3 : 0)
    , Fields(fields)
    , Sums(sums)
  {
  }

  /// Adds the parts of a triangle in the rows [first, end).
  void add(const PlaneTriangle& triangle, int first, int end)
  {
    const Box2 box = triangle.box();
    const auto [lowest, beyond] = this->Rows.between(box.Min.y, box.Max.y);
    first = std::max(first, lowest);
    end = std::min(end, beyond);
    if (first >= end || box.Max.x <= this->Columns[0] ||
      box.Min.x >= this->Columns[this->Columns.size()])
    {
      return;
    }
    this->Origin = triangle.At[0];
    this->Cell = triangle.Cell;
    Part* rest = &this->Parts[0];
    Part* above = &this->Parts[1];
    rest->clear();
    for (int i = 0; i < 3; ++i)
    {
      Corner corner{ triangle.At[i] - this->Origin, {} };
      for (int k = 0; k < 3; ++k)
      {
        corner.Value[k] = triangle.cornerOf(i) == k ? 1 : 0;
      }
      rest->add(corner);
    }
    if (box.Min.y < this->Rows[first])
    {
      cutAt<1>(*rest, this->Rows[first] - this->Origin.y, this->Strip, above);
      std::swap(rest, above);
    }
    for (int row = first; row < end && rest->size() > 2; ++row)
    {
      if (box.Max.y <= this->Rows[row + 1])
      {
        this->addRow(*rest, row);
        return;
      }
      cutAt<1>(*rest, this->Rows[row + 1] - this->Origin.y, this->Strip, above);
      this->addRow(this->Strip, row);
      std::swap(rest, above);
    }
  }

private:
  using Part = ConvexPart<3>;
  using Corner = PartCorner<3>;

  /// Cuts a part across an axis.
  template <int Axis>
  static void cutAt(const Part& part, double at, Part& below, Part* above)
  {
    above->clear();
    part.cut([at](const Corner& corner) { return at - (Axis == 0 ? corner.At.x : corner.At.y); },
      [at](Corner& corner) { (Axis == 0 ? corner.At.x : corner.At.y) = at; }, below, above);
  }

  /// The columns of which a strip covers the whole height, and the strip's extent.
  struct Span
  {
    double Low = HUGE_VAL;
    double High = -HUGE_VAL;
    double WholeFrom = -HUGE_VAL; ///< the strip is as high as the row between these
    double WholeTo = HUGE_VAL;
  };

  Span spanOf(const Part& strip, int row) const
  {
    const double borders[2] = { this->Rows[row] - this->Origin.y,
      this->Rows[row + 1] - this->Origin.y };
    double low[2] = { HUGE_VAL, HUGE_VAL };
    double high[2] = { -HUGE_VAL, -HUGE_VAL };
    Span span;
    for (int i = 0; i < strip.size(); ++i)
    {
      const Point2 p = strip[i].At;
      span.Low = std::min(span.Low, p.x);
      span.High = std::max(span.High, p.x);
      for (int k = 0; k < 2; ++k)
      {
        low[k] = p.y == borders[k] ? std::min(low[k], p.x) : low[k];
        high[k] = p.y == borders[k] ? std::max(high[k], p.x) : high[k];
      }
    }
    span.WholeFrom = std::max(low[0], low[1]);
    span.WholeTo = std::min(high[0], high[1]);
    return span;
  }

  void addRow(const Part& strip, int row)
  {
    const Span span = this->spanOf(strip, row);
    const auto [first, end] =
      this->Columns.between(span.Low + this->Origin.x, span.High + this->Origin.x);
    const Part* rest = &strip;
    Part* right = &this->Parts[2];
    Part* other = &this->Parts[3];
    const auto advance = [&]
    {
      rest = right;
      std::swap(right, other);
    };
    if (first < end && span.Low < this->Columns[first] - this->Origin.x)
    {
      cutAt<0>(*rest, this->Columns[first] - this->Origin.x, this->Pixel, right);
      advance();
    }
    for (int column = first; column < end && rest->size() > 2;)
    {
      const double from = this->Columns[column] - this->Origin.x;
      const int whole = from < span.WholeFrom ? column : this->lastWhole(column, span.WholeTo);
      const int next = std::max(whole, column + 1);
      const double at = this->Columns[next] - this->Origin.x;
      const bool isLast = span.High <= at;
      if (!isLast)
      {
        cutAt<0>(*rest, at, this->Pixel, right);
      }
      const Part& found = isLast ? *rest : this->Pixel;
      whole > column ? this->addWhole(found, row, column, whole)
                     : this->addPixel(found, row, column);
      if (isLast)
      {
        return;
      }
      advance();
      column = next;
    }
  }

  /// Returns the end of the columns from `column` on that end before `limit`.
  int lastWhole(int column, double limit) const
  {
    const auto [first, end] = this->Columns.between(this->Columns[column], limit + this->Origin.x);
    int last = std::max(end, column);
    while (last > column && this->Columns[last] - this->Origin.x > limit)
    {
      --last;
    }
    return last;
  }

  RunningSum* sumsOf(int row, int column) const
  {
    return this->Sums.of(std::int64_t(row) * this->Columns.size() + column);
  }

  void addPixel(const Part& part, int row, int column) const
  {
    double weights[3] = {};
    const double area = part.integrate(0, this->Weights, weights);
    if (area > 0)
    {
      this->Fields.add(this->Cell, area, weights, this->sumsOf(row, column));
    }
  }

  /// Adds whole pixels, whose union is a part. Fields are linear along the row.
  void addWhole(const Part& part, int row, int first, int end) const
  {
    const double from = this->Columns[first] - this->Origin.x;
    const double to = this->Columns[end] - this->Origin.x;
    double left[3] = {};
    double right[3] = {};
    for (int k = 0; k < this->Weights; ++k)
    {
      left[k] = middleAt(part, from, k);
      right[k] = middleAt(part, to, k);
    }
    for (int column = first; column < end; ++column)
    {
      const double area = this->Columns.width(column) * this->Rows.width(row);
      const double centre =
        this->Columns[column] - this->Origin.x + this->Columns.width(column) / 2;
      const double share = (centre - from) / (to - from);
      double weights[3];
      for (int k = 0; k < 3; ++k)
      {
        weights[k] = area * (left[k] + share * (right[k] - left[k]));
      }
      this->Fields.add(this->Cell, area, weights, this->sumsOf(row, column));
    }
  }

  /// The mean of value k at the two ends of a part's vertical side.
  static double middleAt(const Part& part, double x, int k)
  {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    double ofLow = 0;
    double ofHigh = 0;
    for (int i = 0; i < part.size(); ++i)
    {
      if (part[i].At.x == x && part[i].At.y < low)
      {
        low = part[i].At.y;
        ofLow = part[i].Value[k];
      }
      if (part[i].At.x == x && part[i].At.y > high)
      {
        high = part[i].At.y;
        ofHigh = part[i].Value[k];
      }
    }
    return ofLow / 2 + ofHigh / 2;
  }

  const PixelBorders& Columns;
  const PixelBorders& Rows;
  const int Weights; ///< how many weights are integrated: 3 or none
  const FieldIntegrals& Fields;
  OverlapSums& Sums;
  Point2 Origin{};
  std::int64_t Cell = 0;
  Part Parts[4];
  Part Strip;
  Part Pixel;
};

/// Rows are worked on in bands of this many, whatever the number of threads.
constexpr int bandRows = 32;

/// The cells that meet each band of rows, in ascending order.
class BandCells
{
public:
  BandCells(const TriangleReader& reader, std::int64_t cells, const PixelBorders& columns,
    const PixelBorders& rows, int threads)
  {
    const int bands = (rows.size() + bandRows - 1) / bandRows;
    this->Cells = GroupedItems<std::int32_t>(std::size_t(bands), threads,
      [&](const auto& visit)
      {
        forIndices(
          cells,
          [&](std::int64_t cell)
          {
            const Box2 box = reader.boxOf(cell);
            if (!isFinite(box) || box.Max.x <= columns[0] || box.Min.x >= columns[columns.size()])
            {
              return;
            }
            const auto [first, end] = rows.between(box.Min.y, box.Max.y);
            for (int band = first / bandRows; band * bandRows < end; ++band)
            {
              visit(std::size_t(band), std::int32_t(cell));
            }
          },
          threads);
      });
    parallelFor(bands, threads,
      [&](std::int64_t band)
      { std::sort(this->Cells.begin(std::size_t(band)), this->Cells.end(std::size_t(band))); });
  }

  std::int64_t bands() const { return std::int64_t(this->Cells.groups()); }
  template <typename Visit>
  void forCells(std::int64_t band, const Visit& visit) const
  {
    std::for_each(this->Cells.begin(std::size_t(band)), this->Cells.end(std::size_t(band)), visit);
  }

private:
  GroupedItems<std::int32_t> Cells;
};

} // namespace

bool addPixels(const Lattice& lattice, const OverlapSource& source, OverlapSums& sums, int threads,
  const Report& report)
{
  if (source.Mesh.Cells > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("A mesh of more than 2147483647 triangles cannot be averaged at once.");
  }
  const TriangleReader reader(source.Mesh);
  const PixelBorders columns(lattice, source.Mesh.Axes[0]);
  const PixelBorders rows(lattice, source.Mesh.Axes[1]);
  const FieldIntegrals fields(reader, source.Fields, source.Parents);
  const bool isWeighted = anyOfPoints(source.Fields);
  const BandCells cells(reader, source.Mesh.Cells, columns, rows, threads);
  return forChunks(cells.bands(), 1, threads, report,
    [&](std::int64_t band, std::int64_t, int)
    {
      PixelCutter cutter(columns, rows, isWeighted, fields, sums);
      const int first = int(band) * bandRows;
      const int end = std::min(first + bandRows, rows.size());
      cells.forCells(band,
        [&](std::int32_t cell)
        {
          PlaneTriangle triangle;
          if (reader.read(cell, triangle))
          {
            cutter.add(triangle, first, end);
          }
        });
    });
}

std::vector<double> sharesOfPixels(
  const Lattice& lattice, const int (&axes)[2], const OverlapSums& sums, int threads)
{
  const PixelBorders columns(lattice, axes[0]);
  const PixelBorders rows(lattice, axes[1]);
  std::vector<double> shares(std::size_t(sums.targets()), 0);
  forIndices(
    rows.size(),
    [&](std::int64_t row)
    {
      for (int column = 0; column < columns.size(); ++column)
      {
        const double width = columns.width(column);
        const double height = rows.width(int(row));
        const std::int64_t pixel = row * columns.size() + column;
        const double share = coveredShare(sums.areaOf(pixel), width * height);
        const double rounding =
          roundingOf(columns.largest()) / width + roundingOf(rows.largest()) / height;
        shares[std::size_t(pixel)] = share > rounding ? share : 0;
      }
    },
    threads);
  return shares;
}

} // namespace tipp
