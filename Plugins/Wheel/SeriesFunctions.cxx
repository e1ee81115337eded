// SPDX-License-Identifier: BSD-3-Clause
// Maps of the output of models through time.
#include "Binding.h"

#include "Parallel/ParallelFor.h"
#include "Series/SampleSeries.h"

#include <nanobind/stl/array.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp::python
{
namespace
{

SeriesRequest seriesRequestOf(const nb::dict& given)
{
  SeriesRequest request;
  request.Arrays = of<std::vector<std::string>>(given, "arrays");
  request.Step = of<std::string>(given, "step");
  request.Reduce = of<std::vector<std::string>>(given, "reduce");
  request.WithSteps = of<bool>(given, "with_steps");
  request.Waterline = of<std::string>(given, "waterline");
  request.NoData = of<std::optional<double>>(given, "no_data");
  request.Threads = of<int>(given, "threads");
  return request;
}

SeriesRange rangeOf(const nb::dict& given)
{
  SeriesRange range;
  if (const auto bounds = of<std::optional<std::array<double, 4>>>(given, "bounds"))
  {
    range.Bounds = boxOfVtkBounds<2>(bounds->data());
  }
  range.Dimensions = of<std::array<int, 2>>(given, "dimensions");
  range.Delta = of<std::array<double, 2>>(given, "spacing");
  return range;
}

nb::list arraysOf(SampledSeries& series)
{
  nb::list arrays;
  for (std::size_t i = 0; i < series.Samples.size(); ++i)
  {
    const SeriesField& field = series.Description.Fields[i];
    nb::dict described;
    described["long_name"] = field.LongName;
    described["standard_name"] = field.StandardName;
    described["units"] = field.Units;
    described["varies"] = field.Varies;
    std::vector<float>& samples = series.Samples[i];
    Buffer<float> buffer(samples.size());
    std::memcpy(buffer.data(), samples.data(), samples.size() * sizeof(float));
    std::vector<float>().swap(samples);
    arrays.append(nb::make_tuple(field.Name, arrayOf(std::move(buffer)), described));
  }
  return arrays;
}

/// Returns the grid, the steps, their times and the arrays, each with its description; and
/// warnings.
nb::dict resampleSeriesOf(const std::string& path, const nb::dict& given, Progress progress)
{
  Reporter reporter(std::move(progress));
  const SeriesOptions model = seriesOptions(given);
  const SeriesRequest request = seriesRequestOf(given);
  const SeriesRange range = rangeOf(given);
  const auto crs = of<std::string>(given, "crs");
  std::optional<SampledSeries> series = withoutLock(
    [&]
    {
      const ThreadLimit limit(request.Threads);
      return sampleSeries(path, model, request, range, crs, reporter.function());
    });
  reporter.finish();
  const SeriesDescription& description = series->Description;
  const Lattice& grid = description.Grid;
  nb::dict result;
  result["origin"] = std::vector<double>{ grid.Min[0], grid.Min[1] };
  result["spacing"] = std::vector<double>{ grid.Delta[0], grid.Delta[1] };
  result["dimensions"] = std::vector<std::int64_t>{ grid.size(0), grid.size(1) };
  result["steps"] = series->Steps;
  result["times"] = description.Times;
  result["time_units"] = description.TimeUnits;
  result["calendar"] = description.Calendar;
  result["crs"] = series->Wkt.empty() ? description.Crs : series->Wkt;
  result["warnings"] = series->Warnings;
  result["arrays"] = arraysOf(*series);
  return result;
}

} // namespace

void addSeriesFunctions(nb::module_& module)
{
  module.def("resample_series", &resampleSeriesOf);
}

} // namespace tipp::python
