// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunStatistics_h
#define tippRunStatistics_h

#include "Constraints/ResolveCrossings.h"
#include "Distributed/DistributedTriangulation.h"
#include "Distributed3D/DistributedTetrahedralization.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/OutOfCoreTetrahedralization.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace tipp
{

/// Values of a run's statistics, with their name in JSON files and Python (Key) and in VTK tables
/// (Array). If a name is empty, the values do not appear there.
struct Figures
{
  std::string Key;   ///< name in JSON and Python
  std::string Array; ///< name in VTK tables
  std::variant<std::vector<bool>, std::vector<std::int64_t>, std::vector<std::uint64_t>,
    std::vector<double>, std::vector<std::string>>
    Values;
};

/// A list of phases, stages or ranks: columns of equal length.
struct FigureList
{
  std::string Key;      ///< name of the list in JSON and Python; empty: not there
  bool IsTable = false; ///< true: columns of the VTK table; false: its field data
  std::vector<Figures> Columns;
};

/// The statistics of a run. JSON files, VTK tables and Python dictionaries are made from them.
struct RunStatistics
{
  std::vector<Figures> Totals; ///< single values
  std::vector<FigureList> Lists;

  /// Adds a single value to Totals. Signed integers are widened to 64 bits.
  template <typename Value>
  void add(const char* key, const char* array, Value value)
  {
    using Stored =
      std::conditional_t<std::is_integral_v<Value> && std::is_signed_v<Value>, std::int64_t, Value>;
    this->Totals.push_back({ key, array, std::vector<Stored>{ value } });
  }
};

///@{
/// Returns the statistics of a run. The number of triangles or tetrahedra is an argument because
/// the cells may have been moved to the output. `isCounted`: the triangles were only counted, not
/// written.
VTKTIPPFILTERS_EXPORT RunStatistics statisticsOf(
  const Triangulation& triangulation, std::int64_t points, std::int64_t triangles);
VTKTIPPFILTERS_EXPORT RunStatistics statisticsOf(
  const Tetrahedralization& mesh, std::int64_t points, std::int64_t tetrahedra);
VTKTIPPFILTERS_EXPORT RunStatistics statisticsOf(
  const OutOfCoreStatistics& statistics, bool isCounted);
VTKTIPPFILTERS_EXPORT RunStatistics statisticsOf(const OutOfCoreStatistics3& statistics);
VTKTIPPFILTERS_EXPORT RunStatistics statisticsOf(const DistributedTriangulation& mine);
VTKTIPPFILTERS_EXPORT RunStatistics statisticsOf(const DistributedTetrahedralization& mine);
///@}

/// Adds to the totals the numbers of constraints, of their edges and of crossings.
VTKTIPPFILTERS_EXPORT void addConstraintTotals(
  const ConstraintFigures& figures, RunStatistics& statistics);

/// Returns the list "stages" of a run or of a master.
VTKTIPPFILTERS_EXPORT FigureList stagesOf(
  const std::vector<TriangulationStatistics::Stage>& stages);

///@{
/// Returns the warnings about a run, one sentence each. `points`: the number of input points;
/// `longEdgesLeftOut`: triangles with long edges were removed.
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(
  const Triangulation& triangulation, std::int64_t points, bool longEdgesLeftOut);
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(
  const Tetrahedralization& mesh, std::int64_t points);
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(const OutOfCoreStatistics& statistics);
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(const OutOfCoreStatistics3& statistics);
std::vector<std::string> warningsOf(const DistributedTriangulation& mine, bool longEdgesLeftOut);
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(
  const DistributedTetrahedralization& mine);
///@}

} // namespace tipp

#endif
