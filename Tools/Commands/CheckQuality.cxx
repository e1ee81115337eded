// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/CheckQuality.h"

#include "Check/QualityChecker.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Meshes/MeshFiles.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <system_error>
#include <utility>

namespace tipp
{
namespace
{

using Json = nlohmann::json;

/// Returns an entry of the member below_bound. Throws IOError if it is not as --stats writes it.
ListedTriangle parseListed(const std::string& path, const Json& entry, std::size_t number)
{
  static const std::map<std::string, ThinReason> reasons{
    { "input angle", ThinReason::InputAngle },
    { "shortest edge", ThinReason::ShortestEdge },
    { "rounding", ThinReason::Rounding },
    { "kept segments", ThinReason::KeptSegments },
    { "most points", ThinReason::MostPoints },
  };
  const auto has = [&entry](const char* name, auto isType)
  { return entry.is_object() && entry.contains(name) && (entry[name].*isType)(); };
  if (!has("triangle", &Json::is_number_integer) || !has("angle", &Json::is_number) ||
    !has("reason", &Json::is_string))
  {
    throw IOError(path,
      fmt::format("entry {} of 'below_bound' lacks a 'triangle', an 'angle' or a 'reason'; give a "
                  "file that 'tipp mesh --stats' has written.",
        number));
  }
  const auto reason = reasons.find(entry["reason"].get<std::string>());
  if (reason == reasons.end())
  {
    throw IOError(path,
      fmt::format("entry {} of 'below_bound' has the reason '{}'; there are 'input angle', "
                  "'shortest edge', 'rounding', 'kept segments' and 'most points'.",
        number, shownText(entry["reason"].get<std::string>())));
  }
  return { entry["triangle"].get<std::int64_t>(), entry["angle"].get<double>(), reason->second };
}

std::vector<ListedTriangle> readListed(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw IOError(path, "cannot be opened; check its name and permissions.");
  }
  const Json json = Json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains("below_bound") || !json["below_bound"].is_array())
  {
    throw IOError(path,
      "is no JSON with a list 'below_bound'; give a file that 'tipp mesh --stats' has written.");
  }
  std::vector<ListedTriangle> listed;
  for (const Json& entry : json["below_bound"])
  {
    listed.push_back(parseListed(path, entry, listed.size()));
  }
  return listed;
}

/// Adds the points and the constraints' points, segments and holes.
void readInput(const QualityArguments& arguments, CheckedMesh& mesh)
{
  if (!arguments.Points.empty())
  {
    mesh.InputXY = readPoints(arguments.Points, arguments.Columns).XY;
  }
  if (arguments.Constraints.empty())
  {
    return;
  }
  ConstraintTable table = readConstraintFiles(arguments.Constraints, arguments.Columns.Wrap);
  if (table.XY.empty() && !table.Edges.empty() && arguments.Points.empty())
  {
    throw IOError(arguments.Constraints.front(),
      "refers to points by their numbers; give the file of these points before the mesh.");
  }
  const auto first = table.XY.empty() ? 0 : std::int64_t(mesh.InputXY.size() / 2);
  mesh.InputXY.insert(mesh.InputXY.end(), table.XY.begin(), table.XY.end());
  for (const auto& [a, b] : table.Edges)
  {
    mesh.Segments.push_back({ a + first, b + first });
  }
  mesh.Holes = std::move(table.Holes);
}

/// Reads the mesh. Throws IOError if it is none of triangles with points in one file.
CheckedMesh readRefined(const QualityArguments& arguments)
{
  std::error_code ignored;
  const char* const formats = "give the mesh with its points in one file, such as .vtu or .14.";
  if (std::filesystem::is_directory(arguments.Mesh, ignored))
  {
    throw IOError(
      arguments.Mesh, fmt::format("is a folder, which --quality cannot read; {}", formats));
  }
  if (holdsTetrahedra(arguments.Mesh))
  {
    throw IOError(
      arguments.Mesh, "has tetrahedra, but --quality checks triangles; give a mesh of triangles.");
  }
  TriangleMesh read = readMesh(arguments.Mesh);
  if (read.XY.empty())
  {
    throw IOError(arguments.Mesh, fmt::format("has no points; {}", formats));
  }
  CheckedMesh mesh;
  mesh.XY = std::move(read.XY);
  mesh.Triangles = std::move(read.Triangles);
  return mesh;
}

void printQuality(const QualityReport& report)
{
  fmt::print(
    "  smallest angle {:.9g} degrees (triangle {})\n", report.LeastAngle, report.LeastAngleAt);
  fmt::print("  largest area {:.9g}, largest ratio of areas across an edge {:.4g}\n",
    report.LargestArea, report.Grading);
  const auto excused = [&report](ThinReason reason) { return report.Excused[std::size_t(reason)]; };
  fmt::print(
    "  {} triangles below {} degrees; excused: {} by input angles (proved); as listed, {} by "
    "the shortest edge, {} by rounding, {} by kept segments and {} by the most points\n",
    report.Below, report.MinAngle, excused(ThinReason::InputAngle),
    excused(ThinReason::ShortestEdge), excused(ThinReason::Rounding),
    excused(ThinReason::KeptSegments), excused(ThinReason::MostPoints));
  fmt::print("  smallest angles in degrees, and numbers of triangles:\n");
  for (std::size_t bin = 0; bin < QualityReport::Bins; ++bin)
  {
    fmt::print("  {:>4} to {:>2} {:>12}\n", int(bin) * QualityReport::BinDegrees,
      int(bin + 1) * QualityReport::BinDegrees, report.Histogram[bin]);
  }
}

} // namespace

ConstraintTable readConstraintFiles(const std::vector<std::string>& paths, int wrap)
{
  ConstraintTable all;
  std::vector<std::array<std::int64_t, 2>> polygons;
  for (const std::string& path : paths)
  {
    const ConstraintTable table = readConstraintFile(path, wrap);
    if (path != paths.front() && table.XY.empty() != all.XY.empty())
    {
      throw IOError(path,
        fmt::format("and {} cannot be combined: one of them refers to points by their numbers, and "
                    "the other has points of its own.",
          paths.front()));
    }
    const auto first = std::int64_t(all.XY.size() / 2);
    all.XY.insert(all.XY.end(), table.XY.begin(), table.XY.end());
    all.Holes.insert(all.Holes.end(), table.Holes.begin(), table.Holes.end());
    for (std::size_t i = 0; i < table.Edges.size(); ++i)
    {
      const auto& [a, b] = table.Edges[i];
      (i < table.PolygonBegin ? all.Edges : polygons).push_back({ a + first, b + first });
    }
  }
  all.PolygonBegin = all.Edges.size();
  all.Edges.insert(all.Edges.end(), polygons.begin(), polygons.end());
  return all;
}

int checkQualityOfFiles(const QualityArguments& arguments)
{
  CheckedMesh mesh = readRefined(arguments);
  readInput(arguments, mesh);
  mesh.MinAngle = arguments.MinAngle;
  if (arguments.MaxArea)
  {
    mesh.MaxArea = [area = *arguments.MaxArea](check::Position) { return area; };
  }
  if (!arguments.Listed.empty())
  {
    mesh.Listed = readListed(arguments.Listed);
  }
  const QualityReport report = checkQuality(mesh);
  fmt::print("{} points, {} triangles, {} segments: {}\n", report.Mesh.Points, report.Mesh.Cells,
    mesh.Segments.size(), report.isCorrect() ? "correct" : "FAULTY");
  for (const std::string& line : report.faults())
  {
    fmt::print("  {}\n", line);
  }
  if (mesh.InputXY.empty())
  {
    fmt::print("  the mesh's border is not checked, as no input is given\n");
  }
  printQuality(report);
  return report.isCorrect() ? Success : Failure;
}

} // namespace tipp
