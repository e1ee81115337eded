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

/// A raster in memory of the points of a stream: the samples of makeDem(). `memory`: bytes that
/// points and triangles may take; what does not fit goes to a temporary folder. 0: no limit. Throws
/// IOError, std::runtime_error if there is no finite point or a band's column is missing, and
/// std::invalid_argument for constraints.
VTKTIPPFILTERS_EXPORT DemFigures makeDem(std::unique_ptr<PointStream> points,
  const DemRequest& request, std::uint64_t memory, const std::function<bool(double)>& progress,
  TerrainSettings& settings, SampledBands& samples);

/// Those of a run out of core whose triangles became a raster.
VTKTIPPFILTERS_EXPORT DemFigures figuresOf(const OutOfCoreStatistics& statistics);

} // namespace tipp

#endif
