// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeriesReport_h
#define tippSeriesReport_h

#include <string>
#include <vector>

namespace tipp
{

class MeshSeries;
struct SeriesLeftOut;

/// Warns of each variable that the output of a model in a file has and its series does not offer,
/// with the reason.
void warnOfVariablesLeftOut(const std::string& path, const std::vector<SeriesLeftOut>& leftOut);

/// Warns of what flat and partitioned meshes do not keep of the output of a model.
void warnOfDescriptionLost(
  const std::string& path, const std::string& timeUnits, const std::string& crs);

/// Prints the mesh, its variables, the time steps, and what is left out.
void describeSeries(MeshSeries& series);

} // namespace tipp

#endif
