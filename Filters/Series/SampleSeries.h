// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleSeries_h
#define tippSampleSeries_h

#include "Parallel/ParallelFor.h"
#include "Series/PlanSeries.h"
#include "Series/ResampleSeries.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Time steps of a mesh on a regular grid, in memory.
struct SampledSeries
{
  SeriesDescription Description;  ///< its times are the chosen steps' times
  std::vector<std::size_t> Steps; ///< the chosen steps
  std::string Wkt;                ///< of Description.Crs, in version 1; empty: unknown
  /// By field: the samples of all its steps, one step after another, or once if it does not vary;
  /// the first axis fastest. NaN where there is no value.
  std::vector<std::vector<float>> Samples;
  std::vector<std::string> Warnings;
};

/// Resamples the output of a model, or a stored mesh of triangles, as resampleSeries() does. `crs`:
/// the reference system, instead of the one that the file states; empty: not given. Nothing if
/// `progress` stopped it. Throws IOError, std::runtime_error.
VTKTIPPFILTERS_EXPORT std::optional<SampledSeries> sampleSeries(const std::string& path,
  const SeriesOptions& options, const SeriesRequest& request, const SeriesRange& range,
  const std::string& crs, const Report& progress);

} // namespace tipp

#endif
