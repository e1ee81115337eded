// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippElevation_h
#define tippElevation_h

#include "vtkSmartPointer.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cmath>
#include <vector>

class vtkPointSet;

namespace tipp
{

class Communicator;

/// The name of the point array with the heights of a surface.
constexpr const char* elevationName = "elevation";

/// The lowest and the highest finite z of points.
struct HeightRange
{
  double Low = HUGE_VAL;
  double High = -HUGE_VAL;

  void add(double z)
  {
    this->Low = std::isfinite(z) ? std::min(this->Low, z) : this->Low;
    this->High = std::isfinite(z) ? std::max(this->High, z) : this->High;
  }
  VTKTIPPFILTERS_EXPORT void add(vtkPointSet* mesh);
  /// Combines the ranges of all ranks, on all ranks. Collective.
  VTKTIPPFILTERS_EXPORT void gather(Communicator& ranks);

  bool isFlat() const { return !(this->Low < this->High); }
};

/// Whether the meshes of all ranks are surfaces whose points differ in z. Collective.
VTKTIPPFILTERS_EXPORT bool haveElevation(
  const std::vector<vtkPointSet*>& meshes, Communicator& ranks);

/// Returns a shallow copy of the mesh with z as the point array "elevation", in the type of the
/// coordinates; the mesh itself if it has an array of that name.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPointSet> withElevation(vtkPointSet* mesh);

} // namespace tipp

#endif
