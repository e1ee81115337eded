// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeriesReport_h
#define tippSeriesReport_h

#include <functional>
#include <string>
#include <vector>

namespace tipp
{

class MeshSeries;
struct MeshDescription;
struct SeriesLeftOut;

/// Warns of each variable that the output of a model in a file has and its series does not offer,
/// with the reason.
void warnOfVariablesLeftOut(const std::string& path, const std::vector<SeriesLeftOut>& leftOut);

/// Prints the number of time steps, the first and the last time, and their unit; nothing if there
/// are none.
void printTimes(
  const std::vector<double>& times, const std::string& units, const std::string& calendar);

/// Prints an array: where its values are, whether they vary, and what they are.
void printArray(const std::string& name, const char* where, bool varies, const std::string& units,
  const std::string& longName);

/// Warns of arrays with a value that stands for none, which is a number like others where single
/// steps are evaluated. `chosen`: the arrays' names; empty: all. `advice` says what to do.
void warnOfMissingValues(const std::string& path, const MeshDescription& description,
  const std::vector<std::string>& chosen, const std::function<std::string(double missing)>& advice);

/// Prints the mesh, its variables, the time steps, and what is left out.
void describeSeries(MeshSeries& series);

} // namespace tipp

#endif
