// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHull_h
#define tippHull_h

#include "Triangulation/BoundaryCells.h"
#include "vtkTIPPFiltersModule.h"

#include <vector>

namespace tipp
{

/// Receives final cells: those that no later partition can change.
template <int D>
class FinalCellConsumer
{
public:
  virtual ~FinalCellConsumer() = default;
  /// Adds a cell, which may have artificial corners.
  virtual void add(const BoundaryCell<D>& cell) = 0;
};

/// Removes the artificial points (Lemma 3): triangulates `vertices`, the true corners of cells with
/// artificial corners (repetitions allowed), and adds those cells to `final` that are in conflict
/// with an artificial point. They fill the space of the cells with artificial corners. The
/// artificial points lie on the sides of a box.
template <int D>
VTKTIPPFILTERS_EXPORT void repairHull(std::vector<VertexOf<Point<D>>> vertices,
  const std::vector<VertexOf<Point<D>>>& artificial, FinalCellConsumer<D>& final);

} // namespace tipp

#endif
