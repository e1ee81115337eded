// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/CellGrid.h"

#include <cmath>

namespace tipp
{
namespace
{

/// Without branches, so that compilers vectorise it.
inline void findCells(const CellGrid::Axis& columns, const CellGrid::Axis& rows,
  const Point2* points, std::size_t count, std::uint32_t* cells)
{
  const CellGrid::Axis column = columns;
  const CellGrid::Axis row = rows;
  const std::uint32_t width = column.size();
  const std::uint32_t outside = width * row.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Point2 p = points[i];
    const std::uint32_t cell = row(p.y) * width + column(p.x);
    const double nothing = (p.x - p.x) + (p.y - p.y); // NaN if a coordinate is not finite
    cells[i] = nothing == 0 ? cell : outside;
  }
}

// `flatten` inlines all calls, so that everything is compiled for the function's instruction set.

[[gnu::flatten]] void findCommon(const CellGrid::Axis& columns, const CellGrid::Axis& rows,
  const Point2* points, std::size_t count, std::uint32_t* cells)
{
  findCells(columns, rows, points, count, cells);
}

#ifdef __x86_64__
[[gnu::flatten, gnu::target("avx2,bmi,bmi2")]] void findAvx2(const CellGrid::Axis& columns,
  const CellGrid::Axis& rows, const Point2* points, std::size_t count, std::uint32_t* cells)
{
  findCells(columns, rows, points, count, cells);
}
#endif

} // namespace

CellGrid::Axis::Axis(double low, double high, std::uint32_t count)
{
  const double scale = count / (high - low);
  if (std::isfinite(scale))
  {
    this->Low = low;
    this->Scale = scale;
    this->Last = count - 1;
  }
}

CellGrid::CellGrid(const Box2& box, std::uint32_t perSide)
  : Columns(box.xmin, box.xmax, perSide)
  , Rows(box.ymin, box.ymax, perSide)
{
}

void CellGrid::find(
  const Point2* points, std::size_t count, std::uint32_t* cells, Instructions instructions) const
{
#ifdef __x86_64__
  if (hasAvx2(instructions))
  {
    findAvx2(this->Columns, this->Rows, points, count, cells);
    return;
  }
#endif
  static_cast<void>(instructions);
  findCommon(this->Columns, this->Rows, points, count, cells);
}

} // namespace tipp
