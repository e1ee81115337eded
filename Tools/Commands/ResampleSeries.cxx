// SPDX-License-Identifier: BSD-3-Clause
#include "Series/ResampleSeries.h"
#include "Commands/OpenSeries.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/ResampleArguments.h"
#include "Commands/ResampleImage.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Parallel/Stopwatch.h"
#include "Raster/RasterFile.h"
#include "Series/PlanSeries.h"
#include "Series/SeriesFiles.h"
#include "Series/StepSelection.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tipp
{
bool isSeriesRun(const ResampleArguments& arguments)
{
  const bool isOneStep = std::all_of(
    arguments.Step.begin(), arguments.Step.end(), [](char c) { return c >= '0' && c <= '9'; });
  return !isOneStep || !arguments.Reduce.empty() || !arguments.Waterline.empty() ||
    !arguments.Values.empty() || arguments.Wrap || isMeshSeries(arguments.Input) ||
    !formatOf(arguments.Output, Use::WritesRasters);
}

namespace
{

void refuseOthers(const ResampleArguments& arguments)
{
  refuseIf(arguments.Method != "linear", "--method",
    "conservative is for a single step of a flat or partitioned mesh: 'tipp partition' it, and "
    "give "
    "--step N");
  refuseIf(arguments.Device != "auto" && arguments.Device != "openmp", "--device",
    "must be openmp for time steps");
  refuseIf(arguments.Null && openerOf(arguments.Output, Use::WritesSeries) != Opener::GeoTiff,
    "--null", "is for .tif; samples of time steps that have no value are NaN");
  refuseIf(!formatOf(arguments.Output, Use::WritesSeries), "--output",
    "must end in " + listFormats(Use::WritesSeries) + " for time steps");
  refuseIf(arguments.WithSteps && arguments.Reduce.empty(), "--with-steps", "needs --reduce");
}

SeriesRequest requestOf(const ResampleArguments& arguments)
{
  for (const std::string& text : arguments.Reduce)
  {
    refuseIf(!SeriesReduction::parse(text), "--reduce",
      "is '" + text + "'; give max, min, mean, time-of-max or above:LEVEL");
  }
  SeriesRequest request;
  request.Arrays = arguments.Arrays;
  request.Step = arguments.Step;
  request.Reduce = arguments.Reduce;
  request.WithSteps = arguments.WithSteps;
  request.Waterline = arguments.Waterline;
  request.NoData = arguments.NoData;
  request.Threads = arguments.Threads;
  return request;
}

SeriesRange rangeOf(const ResampleArguments& arguments)
{
  SeriesRange range;
  if (!arguments.Bounds.empty())
  {
    const std::vector<double>& b = arguments.Bounds;
    range.Bounds = Box2{ { b[0], b[2] }, { b[1], b[3] } };
  }
  if (!arguments.Dimensions.empty())
  {
    range.Dimensions = { arguments.Dimensions[0], arguments.Dimensions[1] };
  }
  if (!arguments.Delta.empty())
  {
    range.Delta = { arguments.Delta[0], arguments.Delta[1] };
  }
  return range;
}

void summarize(const ResampleArguments& arguments, const SeriesSamples& samples,
  const SeriesPlan& plan, double finding, const SeriesTimes& times)
{
  fmt::print(
    "{} of {} samples, {}, {}, {:.3f} s to find the samples, {:.3f} s sampling, "
    "{:.3f} s reducing, {:.3f} s reading, {:.3f} s writing, peak memory {:.0f} MB, in {}\n",
    samples.Kept.inside(), samples.Kept.samples(),
    counted(std::int64_t(plan.Variables.size()), "array", "arrays"),
    counted(std::int64_t(plan.Steps.size()), "step", "steps"), finding, times.Sampling,
    times.Reducing, times.Reading, times.Writing, double(peakMemoryBytes()) / 1e6,
    arguments.Output);
}

} // namespace

int runSeries(const ResampleArguments& arguments)
{
  refuseOthers(arguments);
  const std::unique_ptr<MeshSeries> series =
    openSeries(arguments.Input, { arguments.Values, arguments.Wrap });
  SeriesPlan plan = planSeries(*series, requestOf(arguments));
  if (!arguments.Crs.empty())
  {
    series->Crs = arguments.Crs;
    requireCrs(arguments.Crs);
  }
  // Check the paths before the computation.
  SeriesDescription description = describeSeries(*series, plan, Lattice());
  description.IsOneStep = !arguments.Step.empty() && isOneStep(arguments.Step);
  std::vector<PathState> before;
  std::vector<std::string> inputs = arguments.Values;
  inputs.push_back(arguments.Input);
  for (const std::string& path : SeriesFiles(arguments.Output, description, plan.Steps).paths())
  {
    before.push_back(requireWritable(path, "", inputs));
  }
  const auto bar = std::make_unique<ProgressBar>("resampling");
  const Report report = progressOn(bar);
  const Stopwatch watch;
  const std::optional<SeriesSamples> samples =
    findSamples(*series, rangeOf(arguments), plan.Threads, partOf(report, 0, 0.1));
  if (!samples)
  {
    return reportInterrupt();
  }
  const double finding = watch.seconds();
  plan.Progress = partOf(report, 0.1, 1);
  description.Grid = samples->Grid;
  description.NoData = arguments.Null.value_or(description.NoData);
  const std::unique_ptr<SeriesOutput> output =
    SeriesFiles(arguments.Output, description, plan.Steps).create(before);
  const std::optional<SeriesTimes> times = resampleSeries(*series, *samples, plan, *output);
  if (!times)
  {
    return reportInterrupt();
  }
  output->close();
  warnOfOneSample(arguments, samples->Grid.samples());
  summarize(arguments, *samples, plan, finding, *times);
  return Success;
}

} // namespace tipp
