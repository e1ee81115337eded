// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStreamedDem_h
#define tippStreamedDem_h

#include "Dem/MakeDem.h"
#include "Points/PointStream.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace tipp
{

struct OutOfCoreStatistics;

/// Makes a raster in memory from the points of a stream, with the same values as the other
/// makeDem(). `memory` limits the bytes for points and triangles; what does not fit is spilled to a
/// temporary folder; 0: no limit. Throws IOError, std::runtime_error if there is no finite point or
/// a band's column is missing, and std::invalid_argument for invalid constraints.
VTKTIPPFILTERS_EXPORT DemFigures makeDem(std::unique_ptr<PointStream> points,
  const DemRequest& request, std::uint64_t memory, const std::function<bool(double)>& progress,
  TerrainSettings& settings, SampledBands& samples);

/// Returns the figures of an out-of-core run that made a raster.
VTKTIPPFILTERS_EXPORT DemFigures figuresOf(const OutOfCoreStatistics& statistics);

} // namespace tipp

#endif
