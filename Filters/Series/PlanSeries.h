// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlanSeries_h
#define tippPlanSeries_h

#include "Series/ResampleSeries.h"
#include "vtkTIPPFiltersModule.h"

#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// What a user asks of resampleSeries(), in texts.
struct SeriesRequest
{
  std::vector<std::string> Arrays; ///< empty: all, or with Reduce those that vary
  std::string Step;                ///< see parseSteps(); empty: all
  std::vector<std::string> Reduce; ///< see SeriesReduction::parse()
  bool WithSteps = false;          ///< with Reduce: the steps, too
  std::string Waterline;           ///< the name of SeriesPlan::Depth; may be empty
  std::optional<double> NoData;    ///< a value that counts as none
  int Threads = 0;                 ///< 0: usualThreads()
};

/// Finds the arrays and steps of a request. Throws IOError if the series does not have them.
VTKTIPPFILTERS_EXPORT SeriesPlan planSeries(const MeshSeries& series, const SeriesRequest& request);

} // namespace tipp

#endif
