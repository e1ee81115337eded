// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurfaceOfMesh_h
#define tippSurfaceOfMesh_h

#include "Sampling/SurfacePart.h"
#include "vtkTIPPFiltersModule.h"

#include <string>
#include <vector>

class vtkPointSet;

namespace tipp
{

/// Returns the triangles of a mesh that has passed checkDataSet(), and its arrays of numbers,
/// without ghosts and global ids; the mesh is shared. Cells with a corner that is not finite along
/// `axes` are left out. Throws std::runtime_error, with the mesh's `name`, if it has cells with a
/// volume.
VTKTIPPFILTERS_EXPORT SurfacePart surfaceOf(
  vtkPointSet* mesh, const std::string& name, const std::vector<int>& axes, int threads);

} // namespace tipp

#endif
