// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunStatistics_h
#define tippRunStatistics_h

#include "Constraints/ResolveCrossings.h"
#include "Distributed/DistributedTriangulation.h"
#include "Distributed3D/DistributedTetrahedralization.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore3D/OutOfCoreTetrahedralization.h"
#include "Triangulation/Triangulate.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

class vtkDataObject;
class vtkTable;

namespace tipp
{

/// Figures of a run under the names that they have in JSON files and Python (Key) and in VTK tables
/// (Array); an empty name leaves them out there.
struct Figures
{
  std::string Key;   ///< name in JSON and Python
  std::string Array; ///< name in VTK tables
  std::variant<std::vector<bool>, std::vector<std::int64_t>, std::vector<std::uint64_t>,
    std::vector<double>, std::vector<std::string>>
    Values;
};

/// The phases, stages or ranks of a run: columns of equal length.
struct FigureList
{
  std::string Key;      ///< name of the list in JSON and Python
  bool IsTable = false; ///< columns of the VTK table; else arrays of its field data
  std::vector<Figures> Columns;
};

/// The statistics of a run, from which JSON files, VTK tables and Python dictionaries are made.
struct RunStatistics
{
  std::vector<Figures> Totals; ///< one value each
  std::vector<FigureList> Lists;

  void add(const char* key, const char* array, std::int64_t value)
  {
    this->Totals.push_back({ key, array, std::vector<std::int64_t>{ value } });
  }
};

///@{
/// Returns the statistics of a run. `triangles` is given since the triangles may have been moved to
/// the output; `isCounted`: the triangles were only counted.
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

/// Adds the numbers of constraints, their edges, and crossings.
VTKTIPPFILTERS_EXPORT void addConstraintTotals(
  const ConstraintFigures& figures, RunStatistics& statistics);

/// The list "stages" of a run or a master.
VTKTIPPFILTERS_EXPORT FigureList stagesOf(
  const std::vector<TriangulationStatistics::Stage>& stages);

///@{
/// Returns the warnings about a triangulation of `points` points, one sentence each.
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(
  const Triangulation& triangulation, std::int64_t points, bool longEdgesLeftOut);
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(const OutOfCoreStatistics& statistics);
std::vector<std::string> warningsOf(const DistributedTriangulation& mine);
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(
  const DistributedTetrahedralization& mine);
///@}

/// Fills the empty table: the rows of the statistics' table, and all else as field data. The
/// documentation of vtkTIPPDelaunay2D and vtkTIPPOutOfCoreDelaunay2D lists the arrays.
void fillStatisticsTable(const RunStatistics& statistics, vtkTable* table);

/// Adds the duplicates and rejected points found on this rank as field data, by global ids.
void addAccounts(const std::vector<Duplicate>& duplicates, const std::vector<PointId>& rejected,
  vtkDataObject* output);

} // namespace tipp

#endif
