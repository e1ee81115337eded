// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/CheckQuality.h"

#include "Check/PixelSizes.h"
#include "Check/QualityChecker.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Meshes/MeshFiles.h"
#include "Raster/RasterValues.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
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

/// Reads the lists of the file of --stats. Throws IOError.
void readListed(const std::string& path, CheckedMesh& mesh)
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
  mesh.Listed.emplace();
  for (const Json& entry : json["below_bound"])
  {
    mesh.Listed->push_back(parseListed(path, entry, mesh.Listed->size()));
  }
  if (!json.contains("above_area"))
  {
    return;
  }
  for (const Json& entry : json["above_area"])
  {
    if (!entry.is_object() || !entry.contains("triangle") || !entry["triangle"].is_number_integer())
    {
      throw IOError(path,
        fmt::format("entry {} of 'above_area' lacks a 'triangle'; give a file that 'tipp mesh "
                    "--stats' has written.",
          mesh.ListedLarge.size()));
    }
    mesh.ListedLarge.push_back(entry["triangle"].get<std::int64_t>());
  }
}

/// Lengths of edges that 'tipp mesh' may not exceed. It computes sizes at the nodes of a lattice,
/// which are at most half the smallest size apart or, where that would be more nodes than its
/// limit, 1/4000 of the domain's longer side. It interpolates between these. So wherever the
/// lattice lies, its size is at most the largest of the raster so near.
class LargestSize
{
public:
  LargestSize(const QualityArguments& arguments, const std::vector<double>& xy)
    : Arguments(arguments)
    , Number(wholeNumber<double>(arguments.Size))
  {
    if (!this->Number)
    {
      this->readRaster(xy);
    }
  }

  /// Returns the largest area of a triangle with this centroid.
  double areaAt(check::Position centroid) const
  {
    const double size = this->limited(this->Number ? *this->Number : this->Pixels->at(centroid));
    const double length = this->Arguments.Geographic
      ? size / metersPerDegree / std::sqrt(this->leastCosine(centroid.y))
      : size;
    return std::sqrt(3.0) / 4 * length * length * (1 + rounding);
  }

private:
  static constexpr double metersPerDegree = 6371000 * 3.14159265358979323846 / 180;
  static constexpr double rounding = 1e-9; // of the sizes' interpolation

  double limited(double size) const
  {
    size = this->Arguments.LargestSize ? std::min(size, *this->Arguments.LargestSize) : size;
    return this->Arguments.LeastSize ? std::max(size, *this->Arguments.LeastSize) : size;
  }

  /// The least cosine of a latitude in reach.
  double leastCosine(double latitude) const
  {
    constexpr double degree = 3.14159265358979323846 / 180;
    const double farthest = std::min(90.0, std::fabs(latitude) + this->Reach.y);
    return std::max(1e-9, std::cos(farthest * degree));
  }

  void readRaster(const std::vector<double>& xy);

  const QualityArguments& Arguments;
  std::optional<double> Number;
  std::optional<check::PixelSizes> Pixels;
  check::Position Reach{ 0, 0 }; ///< how far the raster's pixels count, in x and y
};

/// Throws IOError.
void LargestSize::readRaster(const std::vector<double>& xy)
{
  const std::string& path = this->Arguments.Size;
  const auto& bounds = this->Arguments.RasterBounds;
  const std::unique_ptr<RasterValues> raster =
    bounds ? openNpyRaster(path, *bounds) : openRasterValues(path);
  const RasterGrid& grid = raster->grid();
  std::vector<double> sizes(std::size_t(grid.pixels()));
  raster->read({ 0, 0, grid.Columns, grid.Rows }, sizes.data());
  for (const double size : sizes)
  {
    if (std::isfinite(size) && size <= 0)
    {
      throw IOError(path, fmt::format("has the size {:g}; sizes are above 0.", size));
    }
  }
  const Point2 first = grid.firstCentre();
  this->Pixels.emplace(std::move(sizes), std::size_t(grid.Columns),
    check::Position{ first.x, first.y }, check::Position{ grid.Pixel[0], grid.Pixel[1] });
  if (std::isinf(this->Pixels->smallest()))
  {
    throw IOError(path, "has no size; give another raster.");
  }
  double spacing = this->limited(this->Pixels->smallest()) / 2;
  check::Position low{ HUGE_VAL, HUGE_VAL };
  check::Position high{ -HUGE_VAL, -HUGE_VAL };
  for (std::size_t i = 0; i + 1 < xy.size(); i += 2)
  {
    low = { std::min(low.x, xy[i]), std::min(low.y, xy[i + 1]) };
    high = { std::max(high.x, xy[i]), std::max(high.y, xy[i + 1]) };
  }
  if (!(low.x <= gridPosition(grid.West, grid.Pixel[0], 2 * grid.Columns) && high.x >= grid.West &&
        low.y <= grid.north() && high.y >= grid.South))
  {
    throw IOError(path, "lies outside of the mesh; give a raster in its reference system.");
  }
  if (this->Arguments.Geographic)
  {
    this->Reach.y = 1; // a degree is farther than a lattice's spacing
    spacing /= metersPerDegree * std::min(this->leastCosine(low.y), this->leastCosine(high.y));
  }
  constexpr double steps = 4000; // in each direction of a lattice with the most nodes
  spacing = std::max(spacing, std::max(high.x - low.x, high.y - low.y) / steps);
  this->Reach = { spacing, spacing };
  this->Pixels->spread(this->Reach);
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

/// Throws IOError if y are no latitudes though the arguments say so.
void requireLatitudes(const QualityArguments& arguments, const std::vector<double>& xy)
{
  constexpr double pole = 90;
  for (std::size_t i = 1; arguments.Geographic && i < xy.size(); i += 2)
  {
    if (std::fabs(xy[i]) > pole)
    {
      throw IOError(arguments.Mesh,
        fmt::format(
          "has a point with y = {:g}, which is no latitude; leave out --geographic.", xy[i]));
    }
  }
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
  if (report.ExcusedLarge != 0)
  {
    fmt::print("  {} listed triangles above the limit on areas\n", report.ExcusedLarge);
  }
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
  std::optional<LargestSize> size;
  if (!arguments.Size.empty())
  {
    requireLatitudes(arguments, mesh.XY);
    size.emplace(arguments, mesh.XY);
  }
  if (arguments.MaxArea || size)
  {
    const double area = arguments.MaxArea.value_or(std::numeric_limits<double>::infinity());
    mesh.MaxArea = [area, &size](check::Position centroid)
    { return size ? std::min(area, size->areaAt(centroid)) : area; };
  }
  if (!arguments.Listed.empty())
  {
    readListed(arguments.Listed, mesh);
  }
  const std::size_t segments = mesh.Segments.size();
  const bool hasInput = !mesh.InputXY.empty();
  const QualityReport report = checkQuality(std::move(mesh));
  fmt::print("{} points, {} triangles, {} segments: {}\n", report.Mesh.Points, report.Mesh.Cells,
    segments, report.isCorrect() ? "correct" : "FAULTY");
  for (const std::string& line : report.faults())
  {
    fmt::print("  {}\n", line);
  }
  if (!hasInput)
  {
    fmt::print("  the mesh's border is not checked, as no input is given\n");
  }
  printQuality(report);
  return report.isCorrect() ? Success : Failure;
}

} // namespace tipp
