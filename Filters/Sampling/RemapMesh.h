// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRemapMesh_h
#define tippRemapMesh_h

#include "Sampling/RemapSurface.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPointSet;

namespace tipp
{

/// Computes exact means of the arrays of surfaces over the cells of another one: see
/// SurfaceRemapper.
class VTKTIPPFILTERS_EXPORT MeshRemapper
{
public:
  /// `target` must have passed checkDataSet(), and is shared. `names`: of the arrays to average;
  /// empty: all arrays of numbers. `threads` is at least 1. Throws std::runtime_error if the target
  /// has cells with a volume or no cells with an area.
  MeshRemapper(vtkPointSet* target, std::vector<std::string> names, int threads);

  /// Adds a surface, or a part of one, that has passed checkDataSet(), as SurfaceRemapper::add().
  /// Throws std::runtime_error for cells with a volume, too.
  bool add(vtkPointSet* source, const Report& report);

  /// Returns the cells of the target with the means as cell arrays: see SurfaceRemapper::finish().
  /// The target's own arrays are left out.
  vtkSmartPointer<vtkPointSet> finish(double null);

  std::int64_t coveredTwice() const { return this->Remapper.coveredTwice(); }
  std::int64_t covered() const { return this->Remapper.covered(); }

private:
  vtkSmartPointer<vtkPointSet> Target;
  int Threads;
  SurfaceRemapper Remapper;
};

/// Returns the cells of a mesh with these cell arrays, and no others.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPointSet> withCellMeans(
  vtkPointSet* mesh, const std::vector<SurfaceMeans>& means);

} // namespace tipp

#endif
