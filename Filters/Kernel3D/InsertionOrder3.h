// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInsertionOrder3_h
#define tippInsertionOrder3_h

#include "Kernel/CurveOrder.h"
#include "Predicates/Points.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <vector>

namespace tipp
{

/// The order in which the kernel inserts points: rounds, each along a Hilbert curve. It depends
/// only on the coordinates and on the points' indices.
class VTKTIPPFILTERS_EXPORT InsertionOrder3 : public CurveOrder
{
public:
  /// Computes the order of `count` < 2^IndexBits points; replaces the previous order.
  void compute(const Point3* points, std::size_t count);

  /// For each round the position in the order that follows its last point; ascending.
  const std::vector<std::size_t>& roundEnds() const { return this->RoundEnds; }

private:
  std::vector<std::size_t> RoundEnds;
};

} // namespace tipp

#endif
