// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/QueryMesh.h"
#include "Files/IOError.h"
#include "Files/OutputPath.h"
#include "Files/PendingOutput.h"
#include "Npy/NpyFile.h"
#include "Query/ReadZones.h"
#include "Query/Zones.h"
#include "Ranks/Communicator.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

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
  std::vector<std::int64_t> ids;
  if (shared)
  {
    ids = ofCells ? cellsOnRanks(*shared, mesh, region, arguments.Whole)
                  : pointsOnRanks(*shared, mesh, region);
  }
  else
  {
    ids = ofCells ? cellsIn(mesh, region, arguments.Whole) : pointsIn(mesh, region);
  }
  if (shared && !shared->isFirst())
  {
    return;
  }
  if (extensionOf(output) == ".npy")
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
    PendingFile pending(output, before);
    pending.file().write(0, text.data(), text.size());
    pending.commit();
  }
  fmt::print("{} {}, in {}\n", ids.size(), arguments.Ids, output);
}

} // namespace tipp
