// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SampleSeries.h"

#include "Crs/ReferenceSystem.h"
#include "Partitioning/OpenAnySeries.h"
#include "Raster/RasterFile.h"
#include "Sampling/SamplingLattice.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace tipp
{
namespace
{

/// Keeps what is written.
class SamplesInMemory : public SeriesOutput
{
public:
  explicit SamplesInMemory(SampledSeries& result)
    : Result(result)
  {
    const SeriesDescription& description = result.Description;
    const double ofStep = double(description.Grid.samples());
    double values = 0;
    for (const SeriesField& field : description.Fields)
    {
      values += ofStep * double(field.Varies ? description.Times.size() : 1);
    }
    requireMemory(values, sizeof(float) * values);
    for (const SeriesField& field : description.Fields)
    {
      result.Samples.emplace_back(
        std::size_t(description.Grid.samples()) * (field.Varies ? description.Times.size() : 1));
    }
  }

  void write(std::size_t field, std::size_t step, const float* samples) override
  {
    const auto count = std::size_t(this->Result.Description.Grid.samples());
    std::copy_n(samples, count, this->Result.Samples[field].data() + step * count);
  }

  void close() override {}

private:
  SampledSeries& Result;
};

} // namespace

namespace
{

std::vector<std::string> warningsOf(
  const MeshSeries& series, const SeriesSamples& samples, const SeriesRange& range)
{
  std::vector<std::string> warnings;
  for (const SeriesLeftOut& left : series.LeftOut)
  {
    warnings.push_back(left.Name + " " + left.Reason + ", and is left out.");
  }
  const double distance = std::max(range.Delta[0], range.Delta[1]);
  if (const std::string one = warningOfOneSample(samples.Grid.samples(), distance); !one.empty())
  {
    warnings.push_back(one);
  }
  if (samples.Kept.inside() == 0)
  {
    warnings.emplace_back(
      "no sample lies in a cell of the mesh: check the range and the number of samples.");
  }
  return warnings;
}

} // namespace

std::optional<SampledSeries> sampleSeries(const std::string& path, const SeriesOptions& options,
  const SeriesRequest& request, const SeriesRange& range, const std::string& crs,
  const Report& progress)
{
  const std::unique_ptr<MeshSeries> series = openAnySeries(path, options);
  SeriesPlan plan = planSeries(*series, request);
  if (!crs.empty())
  {
    requireCrs(crs);
    series->Crs = crs;
  }
  const std::optional<SeriesSamples> samples =
    findSamples(*series, range, plan.Threads, partOf(progress, 0, 0.1));
  if (!samples)
  {
    return std::nullopt;
  }
  plan.Progress = partOf(progress, 0.1, 1);
  SampledSeries result;
  result.Steps = plan.Steps;
  result.Description = describeSeries(*series, plan, samples->Grid);
  result.Wkt = series->Crs.empty() ? "" : wkt1Of(series->Crs, true);
  SamplesInMemory output(result);
  if (!resampleSeries(*series, *samples, plan, output))
  {
    return std::nullopt;
  }
  result.Warnings = warningsOf(*series, *samples, range);
  return result;
}

} // namespace tipp
