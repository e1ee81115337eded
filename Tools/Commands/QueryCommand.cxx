// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/QueryMesh.h"
#include "Commands/QuerySeries.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/PendingOutput.h"
#include "Files/TextFile.h"
#include "Gis/GisFiles.h"
#include "Npy/NpyFile.h"
#include "Parallel/ParallelFor.h"
#include "Points/ReadPoints.h"
#include "Query/Queries.h"
#include "Query/RankAnswer.h"
#include "Query/WriteLines.h"
#include "Ranks/Communicator.h"
#include "Resident/ResidentMesh.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The options of --zones.
struct ZoneArguments
{
  std::string Path;
  std::string Field; ///< the field with the zones' names; empty: zones are numbered
  double Level = 0;  ///< volumes are computed above this value
};

/// The options of --ids.
struct RegionArguments
{
  std::string Ids; ///< "cells" or "points"; empty: not given
  std::vector<double> Bounds;
  std::string Polygons; ///< path of a file
  bool Whole = false;   ///< only cells that lie completely in the region
};

void writeText(const std::string& path, const std::string& text, const PathState& before)
{
  PendingFile pending(path, before);
  pending.file().write(0, text.data(), text.size());
  pending.commit();
}

Region regionOf(const RegionArguments& arguments, const ResidentMesh& mesh)
{
  Region region;
  if (arguments.Polygons.empty())
  {
    const auto wanted = std::size_t(mesh.mesh().CellSize == 4 ? 6 : 4);
    if (arguments.Bounds.size() < wanted)
    {
      throw IOError("--bounds needs xmin xmax ymin ymax zmin zmax for a mesh of tetrahedra.");
    }
    std::array<double, 6> bounds{};
    std::copy(arguments.Bounds.begin(), arguments.Bounds.end(), bounds.begin());
    region.Box = boxOfVtkBounds<3>(bounds.data());
    return region;
  }
  for (const NamedZone& zone : readZones(arguments.Polygons, ""))
  {
    region.Polygons.insert(region.Polygons.end(), zone.Polygons.begin(), zone.Polygons.end());
  }
  return region;
}

/// Returns the statistics as lines of a .csv file.
std::string tableOf(const std::vector<NamedZone>& zones, const std::vector<std::string>& arrays,
  const std::vector<ZoneStatistics>& statistics)
{
  std::string text = "zone,cells,area";
  const auto out = std::back_inserter(text);
  for (const std::string& array : arrays)
  {
    for (const char* const column : { "min", "max", "mean", "integral", "above" })
    {
      text += "," + quotedField(array + "_" + column);
    }
  }
  text += '\n';
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    // The number of cells and the area count cells that have values of the first array.
    fmt::format_to(
      out, "{},{},{}", quotedField(zones[i].Name), statistics[0].Cells[i], statistics[0].Area[i]);
    for (const ZoneStatistics& of : statistics)
    {
      const bool isMet = of.Cells[i] > 0;
      isMet ? fmt::format_to(
                out, ",{},{},{},{},{}", of.Low[i], of.High[i], of.Mean[i], of.Sum[i], of.Above[i])
            : fmt::format_to(out, ",,,,,");
    }
    text += '\n';
  }
  return text;
}

/// Returns the lines of all ranks on the first one.
Descents gathered(Communicator& ranks, const Descents& own)
{
  Descents all;
  for (const Descents& part : ranks.gather(own))
  {
    const std::int64_t first = all.Starts.back();
    for (std::size_t i = 1; i < part.Starts.size(); ++i)
    {
      all.Starts.push_back(first + part.Starts[i]);
    }
    all.Points.insert(all.Points.end(), part.Points.begin(), part.Points.end());
    all.Values.insert(all.Values.end(), part.Values.begin(), part.Values.end());
    all.Pits.insert(all.Pits.end(), part.Pits.begin(), part.Pits.end());
  }
  return all;
}

/// Adds --ids and the options that define regions. Returns the option --ids.
CLI::Option* addRegionOptions(CLI::App& command, RegionArguments& arguments)
{
  CLI::Option* const ids =
    command
      .add_option("--ids", arguments.Ids, "Write the ids of cells or points in a region, see below")
      ->check(CLI::IsMember({ "cells", "points" }));
  CLI::Option* const bounds =
    command.add_option("--bounds", arguments.Bounds, "The region: xmin xmax ymin ymax [zmin zmax]")
      ->expected(4, 6)
      ->needs(ids);
  command.add_option("--polygons", arguments.Polygons, "The region: a file of polygons")
    ->needs(ids)
    ->excludes(bounds);
  command.add_flag("--whole", arguments.Whole, "Only cells that lie completely in the region")
    ->needs(ids);
  return ids;
}

void writeRegion(Communicator* shared, const ResidentMesh& mesh, const RegionArguments& arguments,
  const std::string& output, const PathState& before)
{
  const Region region = regionOf(arguments, mesh);
  const bool ofCells = arguments.Ids == "cells";
  const std::vector<std::int64_t> ids =
    ofCells ? cellsIn(mesh, region, arguments.Whole, shared) : pointsIn(mesh, region, shared);
  if (shared && !shared->isFirst())
  {
    return;
  }
  if (isOpenedBy(output, Opener::Npy))
  {
    NpyWriter writer(output, "<i8", { std::int64_t(ids.size()) }, before);
    writer.write(ids.data(), ids.size() * sizeof(std::int64_t));
    writer.close();
  }
  else
  {
    std::string text = ofCells ? "cell\n" : "point\n";
    for (const std::int64_t id : ids)
    {
      fmt::format_to(std::back_inserter(text), "{}\n", id);
    }
    writeText(output, text, before);
  }
  fmt::print("{} {}, in {}\n", ids.size(), arguments.Ids, output);
}

// The functions that write query the mesh, and the first rank writes the file. `shared`: the ranks
// that share the mesh, all of which must call the function; null: this process alone. `before`: the
// first rank's state of the output's path before the query. They throw IOError.

/// Writes statistics of arrays in the zones of a file, as .csv.
void writeZones(Communicator* shared, const ResidentMesh& mesh, const ZoneArguments& arguments,
  const std::vector<std::string>& arrays, const std::string& output, const PathState& before)
{
  const bool isFirst = !shared || shared->isFirst();
  const std::vector<NamedZone> named =
    isFirst ? readZones(arguments.Path, arguments.Field) : std::vector<NamedZone>();
  std::vector<Zone> zones;
  zones.reserve(named.size());
  for (const NamedZone& zone : named)
  {
    zones.push_back(zone.Polygons);
  }
  std::vector<ZoneStatistics> statistics;
  std::vector<std::string> names;
  for (const std::string& array : arrays)
  {
    const StoredArray* const description = mesh.find(array);
    const int components = description ? description->Components : 1;
    for (int k = 0; k < components; ++k)
    {
      names.push_back(array + (components > 1 ? "_" + std::to_string(k) : ""));
      statistics.push_back(statisticsOf(mesh, zones, array, k, arguments.Level, shared));
    }
  }
  if (!isFirst)
  {
    return;
  }
  const std::string text = tableOf(named, names, statistics);
  writeText(output, text, before);
  fmt::print("{} zones, in {}\n", zones.size(), output);
}

/// Writes the lines of steepest descent from this rank's points, as .vtp.
void answerDescents(Communicator* shared, const ResidentMesh& mesh,
  const std::vector<Point3>& points, const std::string& array, const std::string& output,
  const PathState& before)
{
  const Descents own = descentsOf(mesh, points, array, 0, shared);
  const Descents descents = shared ? gathered(*shared, own) : own;
  if (shared && !shared->isFirst())
  {
    return;
  }
  writeDescents(output, before, descents, array);
  fmt::print(
    "{} lines of {} points, in {}\n", descents.Pits.size(), descents.Points.size(), output);
}

constexpr const char* footer =
  R"(POINTS  any file of points that 'tipp delaunay' reads. For a mesh of tetrahedra it needs a
        column z.
MESH    a partitioned mesh, made by 'tipp partition' or 'tipp delaunay', of which only
        pieces with points in them are read; or any VTK file of triangles, tetrahedra or
        other cells, which are cut into these.
        Or the output of a model, as for 'tipp resample': values at stations through time.
VALUES  .csv: a line for each point with its coordinates, the id of the cell that contains
        it (-1: outside), and the arrays' values, empty outside. .npy: only the arrays,
        as float64, a row for each point, nan outside.

        Of the output of a model: a line for each time step and station, with the time, the
        station's number from 0, its coordinates and the values; .npy: steps x stations x
        arrays.

ZONES   with --zones: polygons of a .gpkg, .shp, .geojson or .fgb file, or of a .csv file
        with a column WKT, instead of points. VALUES is then a .csv file with a line for
        each feature: the number of its cells, its area on the mesh, and for each array
        minimum, maximum, mean, integral and the volume above --level. Triangles are cut at
        the zone's border.

IDS     with --ids cells or --ids points, instead of points: VALUES (.csv or .npy) is then a
        list of the ids in a region: --bounds, or --polygons, a file as for --zones. A cell
        is listed if it has a point in the region, with --whole if all of it is in there.

A point on an edge, a face or a corner belongs to one cell, by the rule of 'tipp
resample'; it does not depend on pieces, threads and ranks. Under mpirun the ranks share
the pieces and the points, and the first one writes the file. --memory is the limit of
each rank, in bytes or such as 512M (2^20 bytes) or 2G.

Examples:
  tipp query stations.csv coast.tipp -o levels.csv --arrays elevation
  mpirun -np 4 tipp query stations.npy coast.tipp -o levels.npy --memory 512M
  tipp query stations.csv coast.tipp -o nearest.csv --closest
  tipp query gauges.csv fort.63.nc -o series.csv --arrays zeta
  tipp query gauges.csv surge.tipp -o series.csv --step all
  tipp query coast.tipp --zones districts.gpkg --zone-names name -o flooded.csv --level 2.5
  tipp query coast.tipp --ids cells --bounds 0 50 20 80 -o cells.csv
  tipp query springs.csv terrain.tipp -o rivers.vtp --descend elevation
)";

struct QueryArguments
{
  std::string Points;
  QueryMeshArguments Mesh;
  std::string Output;
  std::vector<std::string> Arrays;
  bool Weights = false;
  bool Closest = false;
  std::string Descend; ///< name of an array; empty: not given
  ZoneArguments Zones;
  RegionArguments Region;
  PointOptions Reading;
  std::vector<std::string> Values; ///< more files with values at the mesh's nodes or cells
  std::optional<double> NoData;    ///< a value that counts as none, in the output of a model

  /// Returns whether the query is about the mesh alone, without points.
  bool isOfMesh() const { return !this->Zones.Path.empty() || !this->Region.Ids.empty(); }

  bool toNpy() const { return isOpenedBy(this->Output, Opener::Npy); }
};

/// Returns this rank's share of the points. Throws IOError if points in space have no column z.
std::vector<Point3> readShare(const QueryArguments& arguments, bool inSpace, int rank, int ranks)
{
  PointOptions reading = arguments.Reading;
  reading.Threads = arguments.Mesh.Threads;
  const PointTable table = readPointsShare({ arguments.Points }, reading, rank, ranks);
  if (rank == 0) // it counts the points of all files
  {
    reportLeftOut(table.LeftOut, table.ThinnedOut);
    reportTables(table.Reports);
  }
  const std::vector<std::string> names = table.names();
  const std::size_t z = findElevation(names);
  if (inSpace && z == names.size() && table.size() > 0)
  {
    throw IOError(arguments.Points, "has no column z, which points in a mesh of tetrahedra need.");
  }
  std::vector<Point3> points(table.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { table.XY[2 * i], table.XY[2 * i + 1], inSpace ? table.Columns[z].Values[i] : 0 };
  }
  return points;
}

/// Calls work(value) with component k of an array at a point, in the array's type.
template <typename Work>
void withValue(const MeshAnswer::Array& array, std::size_t point, std::size_t k, const Work& work)
{
  withScalar(array.Type,
    [&](auto zero)
    { work(array.Values.as<decltype(zero)>()[point * std::size_t(array.Components) + k]); });
}

std::vector<std::string> columnsOf(const std::vector<StoredArray>& arrays)
{
  std::vector<std::string> columns;
  for (const StoredArray& array : arrays)
  {
    for (int k = 0; k < array.Components; ++k)
    {
      columns.push_back(
        quotedField(array.Name + (array.Components > 1 ? "_" + std::to_string(k) : "")));
    }
  }
  return columns;
}

std::string headerLine(
  const QueryArguments& arguments, const std::vector<std::string>& columns, int corners)
{
  std::string line = corners == 4 ? "x,y,z,cell" : "x,y,cell";
  for (int i = 0; i < corners && arguments.Weights; ++i)
  {
    line += ",weight_" + std::to_string(i);
  }
  for (const std::string& column : columns)
  {
    line += "," + column;
  }
  if (arguments.Closest)
  {
    line += std::string(",closest_cell,closest_x,closest_y") + (corners == 4 ? ",closest_z" : "") +
      ",distance";
  }
  return line + "\n";
}

/// Returns this rank's lines of a .csv file.
std::string linesOf(const std::vector<Point3>& points, const MeshAnswer& answer, int corners,
  const ClosestLocations& closest)
{
  std::string text;
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    pollAt(std::int64_t(i));
    const Point3& p = points[i];
    const bool inside = answer.Cells[i] >= 0;
    fmt::format_to(out, "{},{},", p.x, p.y);
    corners == 4 ? fmt::format_to(out, "{},", p.z) : out;
    fmt::format_to(out, "{}", answer.Cells[i]);
    for (std::size_t k = 0; k < std::size_t(corners) && !answer.Weights.empty(); ++k)
    {
      inside ? fmt::format_to(out, ",{}", answer.Weights[i * std::size_t(corners) + k])
             : fmt::format_to(out, ",");
    }
    for (const MeshAnswer::Array& array : answer.Arrays)
    {
      for (std::size_t k = 0; k < std::size_t(array.Components); ++k)
      {
        const auto add = [&](auto value) { fmt::format_to(out, ",{}", +value); };
        inside ? withValue(array, i, k, add) : text.push_back(',');
      }
    }
    if (!closest.Cells.empty())
    {
      const Point3& at = closest.Points[i];
      fmt::format_to(out, ",{},{},{}", closest.Cells[i], at.x, at.y);
      corners == 4 ? fmt::format_to(out, ",{}", at.z) : out;
      fmt::format_to(out, ",{}", closest.Distances[i]);
    }
    text += '\n';
  }
  return text;
}

/// Returns this rank's rows of an .npy file, as bytes.
Bytes rowsOf(const MeshAnswer& answer)
{
  std::size_t columns = 0;
  for (const MeshAnswer::Array& array : answer.Arrays)
  {
    columns += std::size_t(array.Components);
  }
  Bytes bytes(answer.Cells.size() * columns * sizeof(double));
  auto* to = bytes.as<double>();
  for (std::size_t i = 0; i < answer.Cells.size(); ++i)
  {
    for (const MeshAnswer::Array& array : answer.Arrays)
    {
      for (std::size_t k = 0; k < std::size_t(array.Components); ++k)
      {
        double number = std::numeric_limits<double>::quiet_NaN();
        if (answer.Cells[i] >= 0)
        {
          withValue(array, i, k, [&](auto value) { number = double(value); });
        }
        *to++ = number;
      }
    }
  }
  return bytes;
}

Bytes bytesOf(const std::string& text)
{
  Bytes bytes(text.size());
  std::copy(text.begin(), text.end(), bytes.begin());
  return bytes;
}

void write(const QueryArguments& arguments, const PathState& before, const std::string& header,
  const std::vector<Bytes>& parts, const std::vector<std::int64_t>& shape)
{
  if (arguments.toNpy())
  {
    NpyWriter writer(arguments.Output, "<f8", shape, before);
    for (const Bytes& part : parts)
    {
      writer.write(part.data(), part.size());
    }
    writer.close();
    return;
  }
  PendingFile pending(arguments.Output, before);
  pending.file().write(0, header.data(), header.size());
  std::uint64_t end = header.size();
  for (const Bytes& part : parts)
  {
    pending.file().write(end, part.data(), part.size());
    end += part.size();
  }
  pending.commit();
}

/// Answers --zones, --ids and --descend. If the mesh is partitioned, the ranks share its pieces;
/// otherwise the first rank works alone.
void answerTogether(const QueryArguments& arguments, Communicator& ranks)
{
  const bool isShared = ranks.size() > 1 && isPartitionedMesh(arguments.Mesh.Path);
  if (!isShared && !ranks.isFirst())
  {
    return;
  }
  Communicator* const shared = isShared ? &ranks : nullptr;
  PathState before;
  if (ranks.isFirst())
  {
    before = requireWritable(arguments.Output, "",
      { arguments.Points, arguments.Mesh.Path, arguments.Zones.Path, arguments.Region.Polygons });
  }
  const std::unique_ptr<ResidentMesh> mesh = openQueryMesh(arguments.Mesh);
  if (ranks.isFirst())
  {
    noteStep(arguments.Mesh, *mesh);
  }
  if (!arguments.Region.Ids.empty())
  {
    writeRegion(shared, *mesh, arguments.Region, arguments.Output, before);
  }
  else if (!arguments.Zones.Path.empty())
  {
    writeZones(shared, *mesh, arguments.Zones,
      arguments.Arrays.empty() ? mesh->names() : arguments.Arrays, arguments.Output, before);
  }
  else
  {
    const int rank = isShared ? ranks.rank() : 0;
    answerDescents(shared, *mesh, readShare(arguments, false, rank, isShared ? ranks.size() : 1),
      arguments.Descend, arguments.Output, before);
  }
}

/// Answers all ranks' points, and writes the file on the first rank. Collective.
void answerAll(const QueryArguments& arguments, Communicator& ranks)
{
  PathState before;
  if (ranks.isFirst())
  {
    before = requireWritable(arguments.Output, "", { arguments.Points, arguments.Mesh.Path });
  }
  const std::unique_ptr<ResidentMesh> mesh = openQueryMesh(arguments.Mesh);
  if (ranks.isFirst())
  {
    noteStep(arguments.Mesh, *mesh);
  }
  AnswerOptions options;
  options.Arrays = arguments.Arrays.empty() ? mesh->names() : arguments.Arrays;
  options.Weights = arguments.Weights;
  std::vector<StoredArray> arrays;
  for (const std::string& name : options.Arrays)
  {
    const StoredArray* const array = mesh->find(name);
    arrays.push_back(array ? *array : StoredArray());
    arrays.back().Name = name;
  }
  const int corners = mesh->mesh().CellSize;
  const std::vector<Point3> points = readShare(arguments, corners == 4, ranks.rank(), ranks.size());
  const auto count = std::int64_t(points.size());
  // If the mesh is not partitioned, every rank has read all of it.
  const bool isShared = mesh->isStored() && ranks.size() > 1;
  Communicator* const shared = isShared ? &ranks : nullptr;
  const MeshAnswer answer = answerOf(*mesh, points.data(), count, options, shared);
  ClosestLocations closest;
  if (arguments.Closest)
  {
    closest = closestTo(*mesh, points.data(), count, shared);
  }
  std::vector<std::int64_t> sums = { count,
    std::count(answer.Cells.begin(), answer.Cells.end(), -1) };
  ranks.sum(sums);
  const std::vector<Bytes> parts = ranks.gather(
    arguments.toNpy() ? rowsOf(answer) : bytesOf(linesOf(points, answer, corners, closest)));
  if (ranks.isFirst())
  {
    const std::vector<std::string> columns = columnsOf(arrays);
    write(arguments, before, headerLine(arguments, columns, corners), parts,
      { sums[0], std::int64_t(columns.size()) });
    fmt::print("{} points, {} outside of the mesh, in {}\n", sums[0], sums[1], arguments.Output);
  }
}

/// Runs the query on all ranks. Collective.
void runQuery(const QueryArguments& arguments, Communicator& ranks)
{
  arguments.isOfMesh() || !arguments.Descend.empty() ? answerTogether(arguments, ranks)
                                                     : answerAll(arguments, ranks);
}

/// Throws CLI::ValidationError unless the output's extension suits the options.
void checkOutput(const QueryArguments& arguments)
{
  const std::string extension = extensionOf(arguments.Output);
  const auto require = [&](bool isRight, const char* wanted)
  {
    if (!isRight)
    {
      throw CLI::ValidationError("'" + arguments.Output + "' does not end in " + wanted);
    }
  };
  if (!arguments.Descend.empty())
  {
    require(extension == ".vtp", ".vtp");
  }
  else if (!arguments.Zones.Path.empty() || arguments.Closest)
  {
    require(extension == ".csv", ".csv");
  }
  else
  {
    require(extension == ".npy" || extension == ".csv", ".csv or .npy");
  }
}

void addOptions(CLI::App& command, QueryArguments& arguments)
{
  command
    .add_option("points", arguments.Points, "A file of points; left out with --zones and --ids")
    ->required();
  command.add_option("mesh", arguments.Mesh.Path, "The mesh, see below");
  command.add_option("-o,--output", arguments.Output, "The file to write, see below")->required();
  command
    .add_option("--arrays", arguments.Arrays,
      "Names of arrays, or elevation for the z of a surface (default: all)")
    ->delimiter(',');
  CLI::Option* const weights = command.add_flag(
    "--weights", arguments.Weights, "Add the barycentric weights of the cell's corners (.csv)");
  CLI::Option* const closest = command.add_flag(
    "--closest", arguments.Closest, "Add the nearest location on the mesh and its distance (.csv)");
  CLI::Option* const zones =
    command.add_option("--zones", arguments.Zones.Path, "Statistics in polygons, see below")
      ->excludes(closest)
      ->excludes(weights);
  command
    .add_option("--zone-names", arguments.Zones.Field, "The field with the names of the zones")
    ->needs(zones);
  command
    .add_option("--level", arguments.Zones.Level, "The value above which volumes are computed")
    ->capture_default_str()
    ->needs(zones);
  CLI::Option* const ids = addRegionOptions(command, arguments.Region)
                             ->excludes(closest)
                             ->excludes(weights)
                             ->excludes(zones);
  command
    .add_option("--descend", arguments.Descend,
      "Lines of steepest descent of this array from each point (.vtp)")
    ->excludes(closest)
    ->excludes(weights)
    ->excludes(zones)
    ->excludes(ids);
  addQueryMeshOptions(command, arguments.Mesh);
  command.add_option("--values", arguments.Values,
    "For the output of a model: more files with values at its nodes or cells, such as fort.63");
  command.add_option("--no-data", arguments.NoData,
    "For the output of a model: a value that counts as none, such as -99999 at dry nodes");
  addPointOptions(command, arguments.Reading);
  addCurveOption(command);
}

StationArguments stationsOf(const QueryArguments& arguments)
{
  return { arguments.Points, arguments.Mesh.Path, arguments.Output, arguments.Arrays,
    arguments.Values, arguments.Mesh.Step, arguments.NoData, arguments.Reading,
    arguments.Mesh.Threads };
}

int run(QueryArguments& arguments)
{
  const bool isOfMesh = arguments.isOfMesh();
  if (isOfMesh != arguments.Mesh.Path.empty())
  {
    throw CLI::ValidationError(isOfMesh ? "give only the mesh with --zones or --ids, without points"
                                        : "give points and a mesh");
  }
  if (!arguments.Region.Ids.empty() && arguments.Region.Bounds.empty() &&
    arguments.Region.Polygons.empty())
  {
    throw CLI::ValidationError("--ids needs a region: --bounds or --polygons");
  }
  if (arguments.Region.Bounds.size() == 5)
  {
    throw CLI::ValidationError("--bounds needs four numbers, or six for tetrahedra");
  }
  if (isOfMesh)
  {
    std::swap(arguments.Points, arguments.Mesh.Path);
  }
  checkOutput(arguments);
  if (const StationArguments stations = stationsOf(arguments); isStationRun(stations))
  {
    refuseIf(isOfMesh || !arguments.Descend.empty() || arguments.Closest || arguments.Weights,
      "--zones, --ids, --descend, --closest and --weights",
      "are not for the output of a model; partition it first, as with 'tipp flatten' and "
      "'tipp partition'");
    return isIdleRank() ? Success : runStations(stations);
  }
  return runOnRanks([&](Communicator& ranks) { runQuery(arguments, ranks); });
}

} // namespace

void addQueryCommand(CLI::App& app, int& exitCode)
{
  addCommand<QueryArguments>(app, exitCode, "query",
    "Finds the cells of a mesh that contain points, and interpolates its arrays there", footer,
    addOptions, run);
}

} // namespace tipp
