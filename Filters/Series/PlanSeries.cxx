// SPDX-License-Identifier: BSD-3-Clause
#include "Series/PlanSeries.h"

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"
#include "Series/StepSelection.h"

#include <cstddef>

namespace tipp
{
namespace
{

std::vector<std::size_t> variablesOf(const MeshSeries& series, const SeriesRequest& request)
{
  std::vector<std::size_t> variables;
  for (const std::string& name : request.Arrays)
  {
    variables.push_back(findSeriesVariable(series, name));
  }
  const bool isAll = request.Arrays.empty();
  for (std::size_t i = 0; isAll && i < series.Variables.size(); ++i)
  {
    // Reductions are of what varies.
    if (series.Variables[i].Varies || request.Reduce.empty() || request.WithSteps)
    {
      variables.push_back(i);
    }
  }
  return variables;
}

std::vector<SeriesReduction> reductionsOf(const MeshSeries& series, const SeriesRequest& request)
{
  std::vector<SeriesReduction> reductions;
  for (const std::string& text : request.Reduce)
  {
    const std::optional<SeriesReduction> reduction = SeriesReduction::parse(text);
    if (!reduction)
    {
      throw IOError(series.Path,
        "is not reduced by '" + shownText(text) +
          "'; give max, min, mean, time-of-max or above:LEVEL.");
    }
    reductions.push_back(*reduction);
  }
  if (!reductions.empty() && series.Times.empty())
  {
    throw IOError(series.Path, "has no time steps, which --reduce needs.");
  }
  return reductions;
}

std::vector<std::size_t> stepsOf(const MeshSeries& series, const SeriesRequest& request)
{
  const std::string problem = request.Step.empty() ? "" : checkSteps(request.Step);
  if (!problem.empty())
  {
    throw IOError(series.Path, "has no such time steps: " + problem + ".");
  }
  if (series.Times.empty())
  {
    parseSteps(request.Step, 0, series.Path);
    return {};
  }
  return parseSteps(request.Step.empty() ? "all" : request.Step, series.Times.size(), series.Path);
}

/// The variable of --waterline. Throws IOError if it does not fit.
std::size_t depthOf(const MeshSeries& series, const SeriesPlan& plan, const std::string& name)
{
  const std::size_t depth = findSeriesVariable(series, name);
  const auto isLevel = [&series](std::size_t i)
  { return series.Variables[i].Varies && !series.Variables[i].OnCells; };
  if (series.Variables[depth].OnCells || series.Variables[depth].Varies)
  {
    throw IOError(series.Path,
      "has '" + name + "', but --waterline needs depths at nodes that do not vary in time.");
  }
  if (plan.Variables.size() != 1 || !isLevel(plan.Variables[0]))
  {
    throw IOError(series.Path,
      "has several arrays, and --waterline is for one, a water level at nodes that varies in time; "
      "name it with --arrays.");
  }
  return depth;
}

} // namespace

SeriesPlan planSeries(const MeshSeries& series, const SeriesRequest& request)
{
  SeriesPlan plan;
  plan.Variables = variablesOf(series, request);
  if (plan.Variables.empty())
  {
    throw IOError(series.Path,
      request.Reduce.empty() ? "has no values at its nodes or cells."
                             : "has no values that vary in time, which --reduce needs.");
  }
  plan.Reductions = reductionsOf(series, request);
  plan.WritesSteps = request.Reduce.empty() || request.WithSteps;
  plan.Steps = stepsOf(series, request);
  if (!request.Waterline.empty())
  {
    plan.Depth = depthOf(series, plan, request.Waterline);
  }
  plan.NoData = request.NoData;
  plan.Threads = threadCount(request.Threads);
  return plan;
}

} // namespace tipp
