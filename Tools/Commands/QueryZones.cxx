// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/QueryMesh.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Files/OutputPath.h"
#include "Files/PendingOutput.h"
#include "Parallel/Poll.h"
#include "Query/LineData.h"
#include "Query/ReadZones.h"
#include "Query/Zones.h"
#include "Vtk/WriteXmlFile.h"

#include "vtkXMLPolyDataWriter.h"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

/// The statistics as lines of a .csv file.
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
    // Cells and area are those with values of the first array.
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

} // namespace

void writeZones(const ResidentMesh& mesh, const ZoneArguments& arguments,
  const std::vector<std::string>& arrays, const std::string& output, const PathState& before)
{
  if (mesh.mesh().CellSize != 3)
  {
    throw IOError("Zones need a mesh of triangles, but this one has tetrahedra.");
  }
  const std::vector<NamedZone> named = readZones(arguments.Path, arguments.Field);
  std::vector<Zone> zones;
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
      statistics.push_back(statisticsOf(mesh, zones, array, k, arguments.Level));
    }
  }
  const std::string text = tableOf(named, names, statistics);
  PendingFile pending(output, before);
  pending.file().write(0, text.data(), text.size());
  pending.commit();
  fmt::print("{} zones, in {}\n", zones.size(), output);
}

void writeDescents(const ResidentMesh& mesh, const std::vector<Point3>& points,
  const std::string& array, const std::string& output, const PathState& before)
{
  const Descents descents = descentsOf(mesh, points, array, 0);
  PendingFile pending(output, before);
  writeXmlFile<vtkXMLPolyDataWriter>(output, pending, polyDataOf(descents, array));
  pending.commit();
  fmt::print("{} lines of {} points, in {}\n", points.size(), descents.Points.size(), output);
}

} // namespace tipp
