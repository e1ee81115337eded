// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellGrid_h
#define tippCellGrid_h

#include "Kernel/Instructions.h"
#include "Predicates/Point2.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>

namespace tipp
{

/// A grid of equal cells over a box, numbered row by row; the number after the last is that of
/// points that are not finite.
class VTKTIPPFILTERS_EXPORT CellGrid
{
public:
  /// The columns or the rows. The cell is a monotone function of the coordinate despite rounding,
  /// so a cut at a coordinate has all lower cells below it and all higher cells above it.
  struct Axis
  {
    double Low = 0;
    double Scale = 0;
    std::uint32_t Last = 0;

    Axis(double low, double high, std::uint32_t count);

    std::uint32_t size() const { return this->Last + 1; }

    std::uint32_t operator()(double x) const
    {
      const double cell = (x - this->Low) * this->Scale;
      const double last = static_cast<std::int32_t>(this->Last);
      const double atLeast = cell > 0 ? cell : 0; // also for NaN
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(atLeast < last ? atLeast : last));
    }
  };

  CellGrid(const Box2& box, std::uint32_t perSide);

  const Axis& columns() const { return this->Columns; }
  const Axis& rows() const { return this->Rows; }
  std::size_t size() const { return std::size_t(this->Columns.size()) * this->Rows.size(); }

  /// Computes the cell of each of `count` points. Points outside the box get the nearest border
  /// cell.
  void find(const Point2* points, std::size_t count, std::uint32_t* cells,
    Instructions instructions = Instructions::Best) const;

private:
  Axis Columns;
  Axis Rows;
};

} // namespace tipp

#endif
