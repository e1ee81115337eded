// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteSurface_h
#define tippWriteSurface_h

#include "Files/PendingOutput.h"
#include "Resample/SimplexMesh.h"
#include "Sampling/RemapSurface.h"
#include "vtkTIPPFiltersModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// Writes triangles and arrays of their cells as a .vtp or .vtu file, by the extension. `before` as
/// for PendingFile. Throws IOError.
VTKTIPPFILTERS_EXPORT void writeSurface(const std::string& path, const PathState& before,
  const SimplexMesh& triangles, const std::vector<SurfaceMeans>& means);

} // namespace tipp

#endif
