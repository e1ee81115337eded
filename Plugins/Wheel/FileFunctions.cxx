// SPDX-License-Identifier: BSD-3-Clause
#include "Binding.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/TableConstraints.h"
#include "OutOfCore/OutOfCoreOptions.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "Files/Formats.h"
#include "Files/OutputFile.h"
#include "Files/RequireApart.h"
#include "Flat/FlatMesh.h"
#include "OutOfCore/OutOfCoreTetrahedralization.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Parallel/Poll.h"
#include "Partitioning/PartitionMesh.h"
#include "Points/ReadPoints.h"
#include "Points/TableColumns.h"
#include "Ranks/Communicator.h"
#include "Reading/PieceSource.h"
#include "Statistics/RunStatistics.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tipp::python
{
namespace
{

using Strings = std::vector<std::string>;

/// Returns (n, 2) coordinates, the columns by name, and the reference system or an empty text.
nb::tuple readPointFiles(const Strings& paths, const std::optional<Strings>& columns,
  const std::vector<int>& classes, int returns, const Strings& keep)
{
  PointOptions options;
  options.Columns = columns;
  options.Las = lasSelection(classes, returns, keep);
  options.Threads = 0;
  const PointTable table = withoutLock([&] { return readPoints(paths, options); });
  warnOfFiles(table.Reports, table.CrsProblem);
  nb::dict named;
  for (const PointTable::Column& column : table.Columns)
  {
    named[column.Name.c_str()] = copyOf(column.Values);
  }
  return nb::make_tuple(copyOf(table.XY, 2), named, table.Crs);
}

/// Returns the names of all columns besides x and y.
Strings columnNames(const Strings& paths)
{
  return withoutLock([&] { return openPointStream(paths, PointOptions())->columns(); });
}

/// Returns the indices of x, y and, if there are heights, z among the names of a table's columns.
std::vector<std::size_t> findColumns(const Strings& names)
{
  try
  {
    const ColumnChoice choice = requireCoordinates(names);
    std::vector<std::size_t> columns = { choice.X, choice.Y };
    if (choice.Z)
    {
      columns.push_back(*choice.Z);
    }
    return columns;
  }
  catch (const std::invalid_argument& error)
  {
    throw nb::value_error(error.what());
  }
}

/// Returns the figures; `cells` is the name of their number.
nb::dict figuresOf(
  const OutOfCoreRunStatistics& statistics, const char* cells, std::int64_t cellCount)
{
  nb::dict result;
  result["points"] = statistics.Points;
  result[cells] = cellCount;
  result["duplicates"] = statistics.Duplicates;
  result["rejected"] = statistics.Rejected;
  result["pieces"] = statistics.Pieces;
  result["spilled_bytes"] = statistics.SpilledBytes;
  result["mesh_bytes"] = statistics.MeshBytes;
  result["resumed"] = statistics.Resumed ? 1 : 0;
  return result;
}

nb::dict figuresOf(const OutOfCoreStatistics& statistics, bool countOnly)
{
  nb::dict result = figuresOf(statistics, "triangles", statistics.Triangles);
  if (countOnly)
  {
    result["triangle_sum"] = statistics.TriangleSum;
  }
  if (statistics.Constraints.Constraints > 0)
  {
    statistics.Constraints.visit(
      [&result](const char* key, const char*, std::int64_t value) { result[key] = value; });
  }
  return result;
}

/// Sets the options that runs in the plane and in space have in common.
void setRunOptions(
  const nb::dict& given, Reporter& reporter, Strings& warnings, OutOfCoreRunOptions& options)
{
  options.MemoryLimit = of<std::uint64_t>(given, "memory");
  options.Threads = of<int>(given, "threads");
  options.MapDuplicates = of<bool>(given, "map_duplicates");
  options.Neighbors = of<bool>(given, "neighbors");
  options.Resume = of<bool>(given, "resume");
  options.Scratch = of<std::string>(given, "scratch");
  options.Progress = reporter.function();
  options.Warn = [&warnings](const std::string& sentence) { warnings.push_back(sentence); };
}

void append(Strings& warnings, const Strings& more)
{
  warnings.insert(warnings.end(), more.begin(), more.end());
}

nb::tuple triangulateFiles(
  const Strings& inputs, const std::string& output, const nb::dict& given, Progress progress)
{
  Reporter reporter(std::move(progress));
  Strings warnings;
  OutOfCoreOptions options;
  setRunOptions(given, reporter, warnings, options);
  std::tie(options.Columns, options.Rows) = of<std::pair<int, int>>(given, "partitions");
  options.MaximumEdge = of<double>(given, "max_edge");
  options.MarkConstraints = of<bool>(given, "mark_constraints");
  options.CountOnly = of<bool>(given, "count_only");
  const ConstraintFiles constraints{ of<std::string>(given, "constraints"),
    of<std::string>(given, "boundary"), of<std::vector<std::pair<double, double>>>(given, "holes"),
    of<int>(given, "crossings") != 0 ? CrossingRule::Split : CrossingRule::Refuse };
  const auto [x, y] = of<std::pair<std::string, std::string>>(given, "columns");
  const PointOptions reading{ x, y };
  OutOfCoreStatistics statistics;
  withoutLock(
    [&]
    {
      Communicator alone(nullptr);
      statistics = triangulateOutOfCoreOnRanks(
        alone,
        [&]
        {
          requireApart({ output, scratchIn(options.Scratch) }, inputs);
          return joinConstraints(openPointStream(inputs, reading), constraints,
            options.MarkConstraints, options.Threads);
        },
        output, options);
    });
  reporter.raiseIfStopped();
  append(warnings, warningsOf(statistics));
  return nb::make_tuple(figuresOf(statistics, options.CountOnly), warnings);
}

nb::tuple tetrahedralizeFiles(
  const Strings& inputs, const std::string& output, const nb::dict& given, Progress progress)
{
  Reporter reporter(std::move(progress));
  Strings warnings;
  OutOfCoreOptions3 options;
  setRunOptions(given, reporter, warnings, options);
  const auto columns = of<std::array<std::string, 3>>(given, "columns");
  PointOptions reading{ columns[0], columns[1] };
  reading.Z = columns[2];
  reading.Threads = options.Threads;
  reading.InSpace = true;
  OutOfCoreStatistics3 statistics;
  withoutLock(
    [&]
    {
      requireApart({ output, scratchIn(options.Scratch) }, inputs);
      statistics = tetrahedralizeOutOfCore(*openPointStream(inputs, reading), output, options);
    });
  reporter.raiseIfStopped();
  append(warnings, warningsOf(statistics));
  return nb::make_tuple(figuresOf(statistics, "tetrahedra", statistics.Tetrahedra), warnings);
}

std::unique_ptr<PieceSource> openSource(const std::string& path, const std::string& tiling,
  std::uint64_t memory, const SeriesOptions& model)
{
  return openPieceSource(path, { TilingChoice::require(tiling), memory, 0, model });
}

/// Returns the times of a mesh's steps, their unit and calendar.
nb::tuple timesOf(const std::string& path, const nb::dict& given)
{
  const SeriesOptions model = seriesOptions(given);
  const auto source = withoutLock([&] { return openPieceSource(path, { {}, 1, 0, model }); });
  const PartitionedMesh& mesh = source->mesh();
  return nb::make_tuple(mesh.Times, mesh.Description.TimeUnits, mesh.Description.Calendar);
}

/// Returns the names of a mesh's point arrays and cell arrays.
nb::tuple arrayNames(const std::string& path, const nb::dict& given)
{
  const auto tiling = of<std::string>(given, "tiling");
  const auto memory = of<std::uint64_t>(given, "memory_limit");
  const SeriesOptions model = seriesOptions(given);
  const auto source = withoutLock([&] { return openSource(path, tiling, memory, model); });
  Strings names[2];
  for (const StoredArray& array : source->mesh().Arrays)
  {
    Strings& list = names[array.OfPoints ? 0 : 1];
    if (std::find(list.begin(), list.end(), array.Name) == list.end())
    {
      list.push_back(array.Name);
    }
  }
  return nb::make_tuple(names[0], names[1]);
}

nb::dict dictOf(Piece&& piece)
{
  const auto cells = std::size_t(piece.CellSize);
  nb::dict result;
  nb::dict ofPoints;
  nb::dict ofCells;
  ofPoints["GlobalPointIds"] = arrayOf(std::move(piece.PointIds), Scalar::Int64);
  ofPoints["vtkGhostType"] = arrayOf(std::move(piece.PointGhosts), Scalar::UInt8);
  ofCells["GlobalCellIds"] = arrayOf(std::move(piece.CellIds), Scalar::Int64);
  if (piece.OwnedCells < piece.Cells)
  {
    Buffer<char> ghosts(std::size_t(piece.Cells));
    std::fill_n(ghosts.as<std::uint8_t>(), piece.OwnedCells, std::uint8_t(0));
    std::fill_n(ghosts.as<std::uint8_t>() + piece.OwnedCells, piece.Cells - piece.OwnedCells,
      std::uint8_t(1));
    ofCells["vtkGhostType"] = arrayOf(std::move(ghosts), Scalar::UInt8);
  }
  for (Piece::Attribute& attribute : piece.Attributes)
  {
    nb::dict& data = attribute.Description.OfPoints ? ofPoints : ofCells;
    data[attribute.Description.Name.c_str()] = arrayOf(std::move(attribute.Values),
      attribute.Description.Type, std::size_t(attribute.Description.Components));
  }
  result["points"] = arrayOf(std::move(piece.Coordinates), piece.PointType, 3);
  result["cells"] =
    arrayOf(std::move(piece.Connectivity), piece.WideIds ? Scalar::Int64 : Scalar::Int32, cells);
  result["point_data"] = ofPoints;
  result["cell_data"] = ofCells;
  return result;
}

bool isIn(const std::optional<Strings>& names, const std::string& name)
{
  return !names || std::find(names->begin(), names->end(), name) != names->end();
}

std::vector<Piece> readRange(PieceSource& source,
  const std::optional<std::array<double, 6>>& bounds, PieceOptions options, bool borrowed,
  bool isStrict)
{
  Communicator alone(nullptr);
  source.prepare(alone);
  std::vector<std::size_t> numbers(source.mesh().Pieces.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t(0));
  std::optional<RangeFilter> range;
  if (bounds)
  {
    const Box3 box = boxOfVtkBounds<3>(bounds->data());
    if (isStrict)
    {
      requireSensible(source.mesh(), box);
    }
    range.emplace(source.mesh(), box);
    numbers = range->pieces();
  }
  options.Borrowed = borrowed || range;
  std::vector<Piece> pieces = source.read(numbers, options);
  for (std::size_t i = 0; range && i < pieces.size(); ++i)
  {
    pieces[i] = range->apply(pieces[i], numbers[i], borrowed);
  }
  return pieces;
}

/// Replaces the pieces by a single one.
void merge(std::vector<Piece>& pieces)
{
  Piece one = mergePieces(pieces);
  pieces.clear();
  pieces.push_back(std::move(one));
}

nb::list readMesh(const std::string& path, const std::optional<std::array<double, 6>>& bounds,
  const nb::dict& given, Progress progress)
{
  Reporter reporter(std::move(progress));
  const auto time = of<std::optional<double>>(given, "time");
  const auto pointArrays = of<std::optional<Strings>>(given, "point_arrays");
  const auto cellArrays = of<std::optional<Strings>>(given, "cell_arrays");
  const auto tiling = of<std::string>(given, "tiling");
  const auto memory = of<std::uint64_t>(given, "memory_limit");
  const bool borrowed = of<bool>(given, "borrowed");
  const bool isMerged = of<bool>(given, "merge");
  const bool isStrict = of<bool>(given, "strict_bounds");
  const SeriesOptions model = seriesOptions(given);
  std::vector<Piece> pieces;
  try
  {
    withoutLock(
      [&]
      {
        const PollScope polled([&] { return reporter(0); });
        const auto source = openSource(path, tiling, memory, model);
        const std::vector<double>& times = source->mesh().Times;
        PieceOptions options;
        if (time)
        {
          const auto after = std::upper_bound(times.begin(), times.end(), *time);
          options.Step = std::max(int(after - times.begin()) - 1, 0);
        }
        for (const StoredArray& array : source->mesh().Arrays)
        {
          options.Wanted.push_back(isIn(array.OfPoints ? pointArrays : cellArrays, array.Name));
        }
        pieces = readRange(*source, bounds, options, borrowed, isStrict);
        if (isMerged && pieces.size() > 1)
        {
          merge(pieces);
        }
      });
  }
  catch (const WorkAborted&)
  {
    reporter.raiseIfStopped();
  }
  reporter.finish();
  nb::list result;
  for (Piece& piece : pieces)
  {
    result.append(dictOf(std::move(piece)));
  }
  return result;
}

PartitionOptions partitionOptions(const nb::dict& given, Reporter& reporter)
{
  PartitionOptions options;
  options.Tiling = TilingChoice::require(of<std::string>(given, "tiling"));
  options.DuplicateBorrowers = of<bool>(given, "duplicate_borrowers");
  options.MemoryLimit = of<std::uint64_t>(given, "memory_limit");
  options.Threads = of<int>(given, "threads");
  options.Device.Kind = Device::OpenMP;
  options.Progress = reporter.function();
  return options;
}

void partitionFile(
  const std::string& input, const std::string& output, const nb::dict& given, Progress progress)
{
  Reporter reporter(std::move(progress));
  const PartitionOptions options = partitionOptions(given, reporter);
  withoutLock(
    [&]
    {
      requireApart({ output }, { input });
      isOpenedBy(input, Opener::Vtk) && !isFlatMesh(input)
        ? partitionVtkFile(input, output, options, nullptr)
        : partitionMesh(openFlatMesh(input), output, options);
    });
  reporter.raiseIfStopped();
}

FlatArray flatArray(const std::string& name, const InputArray& array)
{
  FlatArray result;
  result.Name = name;
  result.Type = scalarOf(array.dtype());
  result.Components = int(componentsOf(array));
  result.Tuples = std::int64_t(array.shape(0));
  result.Values = array.data();
  return result;
}

std::vector<FlatArray> flatArrays(const std::vector<NamedArray>& arrays)
{
  std::vector<FlatArray> result;
  for (const auto& [name, array] : arrays)
  {
    result.push_back(flatArray(name, array));
  }
  return result;
}

void partitionArrays(const InputArray& points, const InputArray& cells, const nb::dict& pointData,
  const nb::dict& cellData, const std::string& output, const nb::dict& given, Progress progress)
{
  Reporter reporter(std::move(progress));
  const PartitionOptions options = partitionOptions(given, reporter);
  const std::vector<NamedArray> ofPoints = namedArrays(pointData, points, "points");
  const std::vector<NamedArray> ofCells = namedArrays(cellData, cells, "cells");
  FlatContent content;
  content.CellSize = int(cells.shape(1));
  content.Points = flatArray("points", points);
  content.PointData = flatArrays(ofPoints);
  content.CellData = flatArrays(ofCells);
  withoutLock(
    [&]
    {
      content.Cells.resize(cells.size());
      withScalar(scalarOf(cells.dtype()),
        [&](auto value)
        {
          const auto* const ids = static_cast<const decltype(value)*>(cells.data());
          std::transform(ids, ids + cells.size(), content.Cells.begin(),
            [](auto id) { return std::int64_t(id); });
        });
      tipp::partitionInMemory([&] { return content; }, "the mesh", output, options);
    });
  reporter.raiseIfStopped();
}

} // namespace

void addFileFunctions(nb::module_& module)
{
  module.def("read_points", &readPointFiles);
  module.def("column_names", &columnNames);
  module.def("find_coordinates", &findColumns);
  module.def("triangulate_files", &triangulateFiles);
  module.def("tetrahedralize_files", &tetrahedralizeFiles);
  module.def("array_names", &arrayNames);
  module.def("read", &readMesh);
  module.def("times", &timesOf);
  module.def("partition_file", &partitionFile);
  module.def("partition_arrays", &partitionArrays);
}

} // namespace tipp::python
