// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/QueryMesh.h"

#include "Commands/PointArguments.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Gis/GisFiles.h"
#include "Npy/NpyFile.h"
#include "Parallel/ParallelFor.h"
#include "Query/Queries.h"
#include "Query/QueryData.h"
#include "Ranks/Communicator.h"
#include "Vtk/DataSets.h"

#include "vtkDataSet.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace tipp
{

void addQueryMeshOptions(CLI::App& command, QueryMeshArguments& arguments)
{
  addStepOption(command, arguments.Step);
  addChecked(command, "--memory", arguments.Memory, checkMemorySize,
    "The memory limit for pieces of a partitioned mesh");
  addThreadsOption(command, arguments.Threads);
}

std::string quotedField(const std::string& name)
{
  if (name.find_first_of(",\"\n") == std::string::npos)
  {
    return name;
  }
  std::string text = "\"";
  for (const char c : name)
  {
    text += c == '"' ? "\"\"" : std::string(1, c);
  }
  return text + "\"";
}

std::unique_ptr<ResidentMesh> openQueryMesh(const QueryMeshArguments& arguments)
{
  ResidentOptions options;
  options.MemoryLimit = *parseMemorySize(arguments.Memory);
  options.Threads = arguments.Threads;
  options.Step = arguments.Step;
  if (isPartitionedMesh(arguments.Path))
  {
    return std::make_unique<ResidentMesh>(arguments.Path, options);
  }
  const vtkSmartPointer<vtkDataSet> data = readDataSet(arguments.Path);
  try
  {
    return std::make_unique<ResidentMesh>(partOf(data, arguments.Threads), options);
  }
  catch (const IOError&)
  {
    throw;
  }
  catch (const std::runtime_error& error)
  {
    throw IOError(arguments.Path, std::string("cannot be used: ") + error.what());
  }
}

int runOnRanks(const std::function<void(Communicator&)>& work)
{
  // With this threshold, large blocks, such as pieces, are returned to the system when they are
  // freed.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  const MpiSession session;
  try
  {
    Communicator ranks(session.controller());
    const PollScope scope(
      [&ranks]()
      {
        if (isInterrupted())
        {
          throw RankFailure(ranks.rank(), true, "The run was stopped.");
        }
        return true;
      });
    ranks.together([&] { work(ranks); });
  }
  catch (const RankFailure& failure)
  {
    return failure.Aborted ? reportInterrupt() : reportFailure();
  }
  catch (const std::exception&)
  {
    return reportFailure();
  }
  return Success;
}

namespace
{

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
    std::copy(arguments.Bounds.begin(), arguments.Bounds.end(), region.Box.begin());
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

} // namespace

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

void writeDescents(Communicator* shared, const ResidentMesh& mesh,
  const std::vector<Point3>& points, const std::string& array, const std::string& output,
  const PathState& before)
{
  const Descents own = descentsOf(mesh, points, array, 0, shared);
  const Descents descents = shared ? gathered(*shared, own) : own;
  if (shared && !shared->isFirst())
  {
    return;
  }
  writeXmlFile(output, before, polyDataOf(descents, array));
  fmt::print(
    "{} lines of {} points, in {}\n", descents.Pits.size(), descents.Points.size(), output);
}

} // namespace tipp
