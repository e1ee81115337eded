// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtkHdfSeries_h
#define tippVtkHdfSeries_h

#include "Series/MeshSeries.h"

#include <memory>
#include <string>

namespace tipp
{

/// Implements openMeshSeries() for .vtkhdf files: an unstructured grid, or poly data of polygons,
/// whose triangles and polygons stay the same at all steps. Components of vectors are variables of
/// their own; the third coordinate is "elevation".
std::unique_ptr<MeshSeries> openVtkHdfSeries(const std::string& path, const SeriesOptions& options);

/// Whether a file is of VTKHDF and has several time steps. Throws IOError if it cannot be read.
bool isVtkHdfSeries(const std::string& path);

} // namespace tipp

#endif
