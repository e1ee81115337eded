// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircBoundaries.h"
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Constraints/ReadRegions.h"
#include "Constraints/TableConstraints.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/PagedMemory.h"
#include "Files/RequireApart.h"
#include "Files/TextFile.h"
#include "InMemory/TriangulateTable.h"
#include "Meshes/MeshFiles.h"
#include "Parallel/Poll.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Predicates/SensibleRange.h"
#include "Raster/RasterValues.h"
#include "Refinement/HolePoints.h"
#include "Refinement/MeshPoints.h"
#include "Refinement/ModelBoundaries.h"
#include "Refinement/NodeDepths.h"
#include "Refinement/NodeOrder.h"
#include "Refinement/ReadSizes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

struct MeshArguments
{
  ConstraintFiles Constraints;
  std::vector<std::string> Points; ///< files of further vertices
  std::string Output;
  std::string Statistics; ///< path of a file; empty: none
  bool Convex = false;

  double MinimumAngle = 30;
  double LargestArea = 0; ///< 0: not given
  double ShortestEdge = 0;
  std::int64_t MostPoints = 0;
  int SmoothingRounds = 0;
  bool KeepBorder = false;
  bool KeepSegments = false;
  std::vector<std::tuple<double, double, double>> Regions; ///< x, y and the largest area
  std::string RegionFile;                                  ///< path; empty: not given
  SizeArguments Sizes;

  bool DepthsAtNodes = false;
  std::string OpenPolygon; ///< path; empty: not given
  std::optional<double> OpenDepth;
  bool KeepOrder = false;
  std::string Memory;  ///< the limit; empty: the mesh is in memory
  std::string Scratch; ///< a folder; empty: that of the output
  int Threads = 0;

  Opener OutputIs = Opener::None;

  bool hasSizes() const
  {
    return !this->Sizes.Size.empty() || this->Sizes.Dis || this->Sizes.WaveLength ||
      this->Sizes.Slope;
  }
  bool depthsAreRaster() const
  {
    const std::string& path = this->Sizes.Depth;
    return formatOf(path, Use::Rasters) ||
      (this->Sizes.RasterBounds && isOpenedBy(path, Opener::Npy));
  }
  bool hasBoundaryLists() const { return this->OutputIs == Opener::Adcirc; }
  bool isOpen() const { return this->OpenDepth || !this->OpenPolygon.empty(); }
  bool sizesNeedDepths() const { return this->Sizes.WaveLength || this->Sizes.Slope; }
};

/// The mesh, and what its statistics are made from.
struct MadeMesh
{
  PointTable Points;       ///< all nodes, or those before the added ones
  Buffer<double> NewXY;    ///< with --memory: of the crossings and the added points
  std::size_t InTable = 0; ///< the number of crossings, which Points has, too
  Buffer<std::int32_t> Triangles;
  std::vector<std::int64_t> Regions;
  std::vector<std::array<std::int64_t, 2>> Segments;
  RefinedMesh Refined; ///< its triangles and points have been moved from
  std::int64_t GivenPoints = 0;
  std::int64_t LeftOut = 0; ///< points that are not in the domain
  std::optional<NodeDepths> Depths;
  ModelBoundaries Boundaries;
  std::int64_t Bandwidth = 0;

  NodesView nodes() const
  {
    return { this->Points, this->NewXY.data() + 2 * this->InTable,
      this->NewXY.size() / 2 - this->InTable };
  }
};

/// Returns the parts of the constraints between the points, which sizes are measured from.
std::vector<std::array<Point2, 2>> shorelineOf(
  const PointTable& points, const SourceConstraints& source)
{
  std::vector<std::array<Point2, 2>> lines;
  const auto at = [&points](PointId id) {
    return Point2{ points.XY[2 * std::size_t(id)], points.XY[2 * std::size_t(id) + 1] };
  };
  for (const Constraint& constraint : source.Constraints)
  {
    lines.push_back({ at(constraint.A), at(constraint.B) });
  }
  return lines;
}

/// The box in which sizes are needed: that of the lines or, of a convex hull, also of the points.
Box2 domainOf(const MeshArguments& arguments, const PointTable& points,
  const std::vector<std::array<Point2, 2>>& lines)
{
  Box2 box = Box2::empty();
  for (const auto& [a, b] : lines)
  {
    box.extend(a);
    box.extend(b);
  }
  for (std::size_t i = 0; arguments.Convex && i < points.size(); ++i)
  {
    box.extend(Point2{ points.XY[2 * i], points.XY[2 * i + 1] });
  }
  return box;
}

/// Throws IOError if the file of regions cannot be read.
RefinementOptions refinementOptions(const MeshArguments& arguments)
{
  RefinementOptions options;
  options.MinimumAngle = arguments.MinimumAngle;
  if (arguments.LargestArea > 0)
  {
    options.LargestArea = arguments.LargestArea;
  }
  options.ShortestEdge = arguments.ShortestEdge;
  options.MostPoints = arguments.MostPoints;
  options.KeepsBorder = arguments.KeepBorder;
  options.KeepsSegments = arguments.KeepSegments;
  for (const auto& [x, y, area] : arguments.Regions)
  {
    options.Regions.push_back({ { x, y }, area });
  }
  if (!arguments.RegionFile.empty())
  {
    for (const RegionLimit& region : readRegions(arguments.RegionFile))
    {
      options.Regions.push_back({ region.Seed, region.LargestArea });
    }
  }
  options.Threads = arguments.Threads;
  return options;
}

/// Appends the first `count` of the points that the mesh has beyond those of the table, with
/// interpolated columns.
void appendPoints(const PointsMesh& mesh, std::size_t count, PointTable& points)
{
  points.XY.insert(points.XY.end(), mesh.NewXY.begin(), mesh.NewXY.begin() + 2 * count);
  for (PointTable::Column& column : points.Columns)
  {
    for (const PointBlend& blend : mesh.Blends)
    {
      column.Values.push_back(
        blend.valueOf([&column](PointId id) { return column.Values[std::size_t(id)]; }));
    }
  }
}

/// Of the first rows of a table, keeps those whose number is not negative, and all others.
void keepRows(const std::vector<std::int64_t>& numbers, PointTable& points)
{
  std::size_t end = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i >= numbers.size() || numbers[i] >= 0)
    {
      points.XY[2 * end] = points.XY[2 * i];
      points.XY[2 * end + 1] = points.XY[2 * i + 1];
      for (PointTable::Column& column : points.Columns)
      {
        column.Values[end] = column.Values[i];
      }
      ++end;
    }
  }
  points.XY.resize(2 * end);
  for (PointTable::Column& column : points.Columns)
  {
    column.Values.resize(end);
  }
}

/// Renumbers the ends of segments: point i becomes numberOf(i).
template <typename NumberOf>
void renumberSegments(const NumberOf& numberOf, MadeMesh& made)
{
  for (auto& segment : made.Segments)
  {
    segment = { numberOf(segment[0]), numberOf(segment[1]) };
  }
}

/// Calls work(begin, end) for slices of the ids of triangles, which may be larger than memory.
template <typename Ids, typename Work>
void forSlices(Ids& ids, const Work& work)
{
  constexpr std::size_t slice = 3 << 16;
  for (std::size_t first = 0; first < ids.size(); first += slice)
  {
    work(ids.data() + first, ids.data() + std::min(ids.size(), first + slice));
    keepMemoryLimits();
  }
}

/// Removes points that are in no triangle, which models do not accept. They are among those given
/// to the refinement, since it uses all points that it adds. Returns how many.
std::int64_t removeUnused(const std::vector<char>& isUsed, MadeMesh& made)
{
  const std::size_t count = isUsed.size();
  std::vector<std::int64_t> numbers(count);
  std::int64_t used = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    numbers[i] = isUsed[i] ? used++ : -1;
  }
  const std::int64_t left = std::int64_t(count) - used;
  if (left > 0)
  {
    const auto numberOf = [&](std::int64_t id)
    { return std::size_t(id) < count ? numbers[std::size_t(id)] : id - left; };
    keepRows(numbers, made.Points);
    forSlices(made.Triangles,
      [&](std::int32_t* begin, const std::int32_t* end)
      {
        for (std::int32_t* id = begin; id != end; ++id)
        {
          *id = std::int32_t(numberOf(*id));
        }
      });
    renumberSegments(numberOf, made);
  }
  return left;
}

TrianglesView viewOf(const MadeMesh& made)
{
  return TrianglesView(made.Triangles.data(), made.Triangles.size() / 3);
}

/// The bandwidth of a mesh that may be larger than memory.
std::int64_t bandwidthOf(const MadeMesh& made)
{
  std::int64_t bandwidth = 0;
  forSlices(made.Triangles,
    [&](const std::int32_t* begin, const std::int32_t* end)
    {
      bandwidth =
        std::max(bandwidth, bandwidthOf(TrianglesView(begin, std::size_t(end - begin) / 3)));
    });
  return bandwidth;
}

/// Renumbers the nodes if that makes the bandwidth smaller.
void orderNodes(MadeMesh& made)
{
  const std::vector<std::int64_t> order = reverseCuthillMcKee(made.Points.size(), viewOf(made));
  const std::int64_t after = bandwidthOf(viewOf(made), order);
  if (after < made.Bandwidth)
  {
    made.Bandwidth = after;
    applyNodeOrder(order, made.Points, made.Triangles);
    const std::vector<std::int64_t> numbers = inverseOrder(order);
    renumberSegments([&](std::int64_t id) { return numbers[std::size_t(id)]; }, made);
  }
}

/// Reports nodes without a depth: VTK's files keep NaN, but models do not run with it. Throws
/// IOError if the output cannot have such nodes, or if there are no others.
void checkDepths(const MeshArguments& arguments, const MadeMesh& made)
{
  const std::string& path = arguments.Sizes.Depth;
  const std::int64_t missing = made.Depths->Missing;
  if (missing == 0)
  {
    return;
  }
  if (missing == std::int64_t(made.Points.size()))
  {
    throw IOError(path,
      "has no depth at any node; give a file of the same place, in the same reference system.");
  }
  if (arguments.OutputIs != Opener::Vtk)
  {
    throw IOError(path,
      fmt::format("has no depths in the parts of the mesh of {}; give a file that covers them, or "
                  "write .vtu, which stores NaN.",
        counted(missing, "node", "nodes")));
  }
  fmt::print(stderr,
    "tipp: warning: {} the depth NaN, because {} has no depths in their parts of the mesh.\n",
    counted(missing, "node has", "nodes have"), path);
}

/// Throws IOError unless points with depths have the column.
void requireColumn(
  const std::string& path, const std::vector<std::string>& names, const std::string& column)
{
  if (std::find(names.begin(), names.end(), column) == names.end())
  {
    throw IOError(path,
      fmt::format("has no column '{}'{}; name one by --depth-column, or give --positive-up for "
                  "elevations in z.",
        column, listOfNames({ names.begin(), names.end() }, "; there are ")));
  }
}

/// Sets the column depth of the nodes. Throws IOError.
void addDepths(const MeshArguments& arguments, MadeMesh& made)
{
  const std::string& path = arguments.Sizes.Depth;
  const std::optional<Box2>& bounds = arguments.Sizes.RasterBounds;
  NodeDepthOptions options;
  options.Axis = arguments.Sizes.DepthIsElevation ? VerticalAxis::Elevations : VerticalAxis::Depths;
  options.Threads = arguments.Threads;
  if (arguments.depthsAreRaster())
  {
    const auto raster =
      isOpenedBy(path, Opener::Npy) ? openNpyRaster(path, *bounds) : openRasterValues(path);
    made.Depths = depthsFromRaster(made.Points.XY, viewOf(made), *raster,
      arguments.DepthsAtNodes ? NodeRule::AtNode : NodeRule::CellMean, options);
  }
  else
  {
    const auto points = openPointStream({ path }, {});
    const std::string column = !arguments.Sizes.DepthColumn.empty() ? arguments.Sizes.DepthColumn
      : arguments.Sizes.DepthIsElevation                            ? "z"
                                                                    : "depth";
    requireColumn(path, points->columns(), column);
    made.Depths = depthsFromPoints(made.Points.XY, viewOf(made), *points, column, options);
  }
  checkDepths(arguments, made);
  auto& columns = made.Points.Columns;
  columns.erase(std::remove_if(columns.begin(), columns.end(),
                  [](const PointTable::Column& column) { return column.Name == "depth"; }),
    columns.end());
  columns.push_back({ "depth", made.Depths->Values });
}

/// The closed lines of a boundary, without repeated corners. Its edges may come in any order and
/// direction, as at each place, compared by x and y, an even number of them ends.
std::vector<std::vector<Point2>> ringsOf(const ConstraintTable& table)
{
  using Place = std::pair<double, double>;
  const auto placeOf = [&table](std::int64_t id) {
    return Place{ table.XY[2 * std::size_t(id)], table.XY[2 * std::size_t(id) + 1] };
  };
  std::map<Place, std::vector<std::size_t>> edgesAt;
  for (std::size_t edge = 0; edge < table.Edges.size(); ++edge)
  {
    edgesAt[placeOf(table.Edges[edge][0])].push_back(edge);
    edgesAt[placeOf(table.Edges[edge][1])].push_back(edge);
  }
  std::vector<bool> isUsed(table.Edges.size(), false);
  const auto takeEdge = [&](const Place& at)
  {
    std::vector<std::size_t>& edges = edgesAt[at];
    while (!edges.empty() && isUsed[edges.back()])
    {
      edges.pop_back();
    }
    return edges.empty() ? table.Edges.size() : edges.back();
  };
  std::vector<std::vector<Point2>> rings;
  for (const auto& first : table.Edges)
  {
    std::vector<Point2> ring;
    Place at = placeOf(first[0]);
    for (std::size_t edge = takeEdge(at); edge < table.Edges.size(); edge = takeEdge(at))
    {
      isUsed[edge] = true;
      ring.push_back({ at.first, at.second });
      const Place end = placeOf(table.Edges[edge][0]);
      at = end == at ? placeOf(table.Edges[edge][1]) : end;
    }
    if (!ring.empty())
    {
      rings.push_back(std::move(ring));
    }
  }
  return rings;
}

/// Returns which nodes may be on an open boundary. Throws IOError.
OpenNodes openNodesOf(const MeshArguments& arguments, const MadeMesh& made)
{
  if (arguments.OpenDepth)
  {
    return nodesDeeperThan(made.Depths->Values, *arguments.OpenDepth);
  }
  if (arguments.OpenPolygon.empty())
  {
    return [](std::int64_t) { return false; };
  }
  return nodesInside(made.Points.XY, ringsOf(readBoundary(arguments.OpenPolygon)));
}

void findBoundaries(const MeshArguments& arguments, MadeMesh& made)
{
  const LandKinds ofSchism{ 0, 1 };
  made.Boundaries = findModelBoundaries(made.Points.XY, viewOf(made), openNodesOf(arguments, made),
    extensionOf(arguments.Output) == ".gr3" ? ofSchism : LandKinds());
  if (arguments.isOpen() && made.Boundaries.Lists.Open.empty())
  {
    fmt::print(stderr,
      "tipp: warning: there is no open boundary, because no two neighbouring nodes of the border "
      "are {}.\n",
      arguments.OpenDepth ? "deeper than --open-deeper" : "in the polygons of --open");
  }
  if (made.Boundaries.TouchingNodes > 0)
  {
    fmt::print(stderr,
      "tipp: warning: the border of the mesh touches itself at {}, with which ADCIRC and SCHISM do "
      "not run.\n",
      counted(made.Boundaries.TouchingNodes, "node", "nodes"));
  }
  if (made.Boundaries.LoneOpenNodes > 0)
  {
    fmt::print(stderr,
      "tipp: warning: {} no open neighbour on the border, and so become mainland.\n",
      counted(made.Boundaries.LoneOpenNodes, "node of the open boundary has",
        "nodes of the open boundary have"));
  }
}

/// Reads the input. Throws IOError.
PointTable readInput(const MeshArguments& arguments, SourceConstraints& source)
{
  PointTable points;
  if (!arguments.Points.empty())
  {
    PointOptions options;
    options.Threads = arguments.Threads;
    points = readPoints(arguments.Points, options);
    reportRead(points.Figures);
    reportTables(points.Reports);
  }
  TableConstraints constraints = readConstraints(arguments.Constraints);
  if (arguments.Points.empty() && !constraints.Lines.Height.empty())
  {
    points.Columns.push_back({ "z", {} });
  }
  source = joinTable(points, constraints, arguments.Threads);
  return points;
}

/// The triangles that are not as asked, and why.
nlohmann::ordered_json listOutside(const RefinedMesh& mesh, double angle, bool isThin)
{
  constexpr double rounding = 1e-6; // of an angle, in degrees
  const auto textOf = [](TriangleOutside::Reason reason)
  {
    switch (reason)
    {
      case TriangleOutside::Reason::InputAngle:
        return "input angle";
      case TriangleOutside::Reason::ShortestEdge:
        return "shortest edge";
      case TriangleOutside::Reason::KeptSegments:
        return "kept segments";
      case TriangleOutside::Reason::MostPoints:
        break;
    }
    return "most points";
  };
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const TriangleOutside& outside : mesh.Outside)
  {
    if ((outside.Angle < angle + rounding) == isThin)
    {
      list.push_back({ { "triangle", outside.Triangle }, { "angle", outside.Angle },
        { "area", outside.Area }, { "reason", textOf(outside.Why) } });
    }
  }
  return list;
}

/// Prints a summary. `json`: the statistics.
void printFigures(const MeshArguments& arguments, const MadeMesh& made,
  const nlohmann::ordered_json& json, double seconds)
{
  fmt::print("{} points, {} in {:.3f} s, {:.1f} MB\n", made.nodes().size(),
    counted(std::int64_t(made.Triangles.size() / 3), "triangle", "triangles"), seconds,
    double(peakMemoryBytes()) / 1e6);
  const auto thin = std::int64_t(json["below_bound"].size());
  const auto large = std::int64_t(json["above_area"].size());
  if (thin > 0)
  {
    const auto forced = std::count_if(made.Refined.Outside.begin(), made.Refined.Outside.end(),
      [](const TriangleOutside& outside)
      { return outside.Why == TriangleOutside::Reason::InputAngle; });
    fmt::print(
      "{} an angle below {:g} degrees, {} of them because segments of the input meet below 60\n",
      counted(thin, "triangle has", "triangles have"), arguments.MinimumAngle, forced);
  }
  if (large > 0)
  {
    fmt::print("{} larger than asked\n", counted(large, "triangle is", "triangles are"));
  }
}

/// Writes the statistics and prints a summary. Throws IOError.
void report(const MeshArguments& arguments, const MadeMesh& made, double seconds)
{
  const RefinementStatistics& figures = made.Refined.Statistics;
  const auto triangles = std::int64_t(made.Triangles.size() / 3);
  nlohmann::ordered_json json = { { "input", arguments.Constraints.name() },
    { "output", arguments.Output }, { "points", made.nodes().size() }, { "triangles", triangles },
    { "points_given", made.GivenPoints }, { "points_left_out", made.LeftOut },
    { "points_added", figures.Inserted }, { "segment_splits", figures.Splits },
    { "levels", figures.Levels }, { "rounds", figures.Rounds }, { "blocks", figures.Blocks },
    { "moves", figures.Moves }, { "bandwidth", made.Bandwidth }, { "mesh_seconds", seconds },
    { "peak_memory_bytes", peakMemoryBytes() } };
  if (made.Depths)
  {
    json["depths"] = { { "from_cells", made.Depths->FromCells },
      { "at_nodes", made.Depths->AtNodes }, { "from_others", made.Depths->FromOthers },
      { "missing", made.Depths->Missing } };
  }
  json["below_bound"] = listOutside(made.Refined, arguments.MinimumAngle, true);
  json["above_area"] = listOutside(made.Refined, arguments.MinimumAngle, false);
  if (!arguments.Statistics.empty())
  {
    writeJson(arguments.Statistics, json);
  }
  printFigures(arguments, made, json, seconds);
}

/// Makes the size function. Throws IOError and std::invalid_argument.
SizeFunction makeSizes(const MeshArguments& arguments, const PointTable& points,
  const SourceConstraints& source, const Report& progress)
{
  const std::vector<std::array<Point2, 2>> lines = shorelineOf(points, source);
  SizeArguments sizes = arguments.Sizes;
  if (!arguments.sizesNeedDepths())
  {
    // The file is for the depths of nodes only.
    sizes.Depth.clear();
    sizes.DepthColumn.clear();
    sizes.DepthIsElevation = false;
  }
  return makeSizeFunction(
    sizes, lines, domainOf(arguments, points, lines), arguments.Threads, progress);
}

/// Throws IOError if the input has columns, which need the mesh in memory.
void requireNoColumns(const MeshArguments& arguments, const PointTable& points)
{
  if (!points.Columns.empty())
  {
    const std::string& path =
      arguments.Points.empty() ? arguments.Constraints.name() : arguments.Points.front();
    throw IOError(path,
      "has the column '" + points.Columns.front().Name +
        "', which --memory cannot interpolate; leave out --memory, or the column.");
  }
}

/// Takes the nodes, triangles and segments over from a mesh.
void takeMesh(const MeshArguments& arguments, PointsMesh&& mesh, MadeMesh& made)
{
  const bool isPaged = !arguments.Memory.empty();
  const std::size_t inTable = isPaged ? std::size_t(mesh.Crossings) : mesh.NewXY.size() / 2;
  appendPoints(mesh, inTable, made.Points);
  if (isPaged)
  {
    made.NewXY = std::move(mesh.NewXY);
    made.InTable = inTable;
  }
  made.Triangles = std::move(mesh.Mesh.Triangles);
  made.Regions.assign(mesh.Mesh.RegionOf.begin(), mesh.Mesh.RegionOf.end());
  for (const IdSegment& segment : mesh.Mesh.Segments)
  {
    made.Segments.push_back({ segment.A, segment.B });
  }
  made.Refined = std::move(mesh.Mesh);
  made.LeftOut = removeUnused(made.Refined.IsUsed, made);
}

/// Makes the mesh in `memory`, without depths and boundaries. Returns false if the user interrupted
/// it.
bool makeMesh(const MeshArguments& arguments, PagedMemory* memory, MadeMesh& made)
{
  SourceConstraints source;
  made.Points = readInput(arguments, source);
  made.GivenPoints = std::int64_t(made.Points.size());
  if (memory)
  {
    requireNoColumns(arguments, made.Points);
  }
  const auto bar = std::make_unique<ProgressBar>("Meshing");
  MeshRequest request;
  request.Source = &source;
  request.Crossings = arguments.Constraints.Crossings;
  request.IsConvex = arguments.Convex;
  request.HasValues = !made.Points.Columns.empty();
  request.Refinement = refinementOptions(arguments);
  request.SmoothingRounds = arguments.SmoothingRounds;
  request.Refinement.Memory = memory;
  const Report progress = progressOn(bar);
  request.Refinement.Progress = progress;
  std::optional<SizeFunction> sizes;
  if (arguments.hasSizes())
  {
    constexpr double share = 0.3;
    sizes = makeSizes(arguments, made.Points, source, partOf(progress, 0, share));
    const auto areaFor = [](double size) { return std::sqrt(3.0) / 4 * size * size; };
    request.Refinement.AreaAt = [&sizes, areaFor](Point2 centroid, double radius)
    { return areaFor(sizes->forTriangle(centroid, radius)); };
    request.Refinement.LeastArea = areaFor(sizes->least());
    request.Refinement.Progress = partOf(progress, share, 1);
  }
  std::vector<std::string> warnings;
  PointsMesh mesh =
    meshPoints(PointsView(made.Points.XY.data(), made.Points.size(), 2), request, warnings);
  if (mesh.Aborted)
  {
    return false;
  }
  if (mesh.Mesh.triangleCount() == 0)
  {
    throw IOError(arguments.Constraints.name(),
      "leaves nothing to mesh, so no file is written; close its lines or polygons, give --convex, "
      "or move the points of holes off the segments.");
  }
  printWarnings(warnings);
  takeMesh(arguments, std::move(mesh), made);
  return true;
}

/// Returns a point in each hole, with which the segments of Triangle's .poly file enclose the mesh.
std::vector<Point2> holesOf(const MadeMesh& made)
{
  const HolePoints holes = findHolePoints(made.nodes(), viewOf(made), made.Segments);
  if (holes.TooThin > 0)
  {
    fmt::print(stderr,
      "tipp: warning: {} too thin for a point, so the .poly file fills what it leaves out.\n",
      counted(holes.TooThin, "hole is", "holes are"));
  }
  return holes.Points;
}

bool writeMade(const MeshArguments& arguments, const MadeMesh& made, const PathState& before)
{
  MeshOptions options;
  options.Before = before;
  options.Aborted = isInterrupted;
  options.Regions = made.Regions;
  options.Boundaries = made.Boundaries.Lists;
  options.Segments = made.Segments;
  options.Crs = arguments.Sizes.Geographic ? "EPSG:4326" : "";
  if (arguments.OutputIs == Opener::Triangle)
  {
    options.Holes = holesOf(made);
  }
  return writeMesh(arguments.Output, made.nodes(), viewOf(made), options);
}

/// Whether --size is a number, not a file.
bool isNumber(const std::string& size)
{
  return wholeNumber<double>(size).has_value();
}

/// Throws IOError if the .poly file beside an output of Triangle's is there without a .node file:
/// it is a graph that a user has written, and no part of a mesh.
void requireNoOtherGraph(const MeshArguments& arguments)
{
  if (arguments.OutputIs != Opener::Triangle)
  {
    return;
  }
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path graph = fs::path(arguments.Output).replace_extension(".poly");
  if (fs::exists(graph, ignored) &&
    !fs::exists(fs::path(arguments.Output).replace_extension(".node"), ignored))
  {
    throw IOError(graph.string(),
      fmt::format("would be replaced by the segments of {}; give the output another name.",
        arguments.Output));
  }
}

/// Throws IOError unless the output files can be written and differ from the inputs: also the .ele
/// and .poly files that belong to a .node file. Returns the state of the output's path.
PathState requireOutputs(const MeshArguments& arguments)
{
  std::vector<std::string> named = arguments.Points;
  named.insert(named.end(),
    { arguments.Constraints.Lines, arguments.Constraints.Boundary, arguments.Sizes.Depth,
      isNumber(arguments.Sizes.Size) ? "" : arguments.Sizes.Size, arguments.OpenPolygon,
      arguments.RegionFile });
  std::vector<std::string> inputs;
  for (const std::string& input : named)
  {
    const std::vector<std::string> files = filesOfMesh(input, false);
    inputs.insert(inputs.end(), files.begin(), files.end());
  }
  std::vector<std::string> outputs = filesOfMesh(arguments.Output, true);
  outputs.push_back(arguments.Statistics);
  requireApart(outputs, inputs);
  requireNoOtherGraph(arguments);
  return requireWritable(arguments.Output, arguments.Statistics, inputs);
}

/// Returns where the mesh is if --memory is given; otherwise null. Throws IOError.
std::unique_ptr<PagedMemory> memoryOf(const MeshArguments& arguments)
{
  if (arguments.Memory.empty())
  {
    return nullptr;
  }
  const std::string folder = arguments.Scratch.empty()
    ? std::filesystem::path(arguments.Output).parent_path().string()
    : arguments.Scratch;
  return std::make_unique<PagedMemory>(folder, *parseMemorySize(arguments.Memory));
}

int runMesh(const MeshArguments& arguments)
{
  const PathState before = requireOutputs(arguments);
  const std::unique_ptr<PagedMemory> memory = memoryOf(arguments);
  MadeMesh made;
  Stopwatch watch;
  if (!makeMesh(arguments, memory.get(), made) || isInterrupted())
  {
    return reportInterrupt();
  }
  made.Bandwidth = bandwidthOf(made);
  if (!arguments.KeepOrder)
  {
    orderNodes(made);
  }
  if (!arguments.Sizes.Depth.empty())
  {
    addDepths(arguments, made);
  }
  if (arguments.hasBoundaryLists())
  {
    findBoundaries(arguments, made);
  }
  const double seconds = watch.restart();
  if (isInterrupted() || !writeMade(arguments, made, before))
  {
    return reportInterrupt();
  }
  report(arguments, made, seconds);
  return Success;
}

/// Throws CLI::ValidationError for options of sizes that would have no effect or lack another one.
void requireFittingSizes(const MeshArguments& arguments)
{
  const SizeArguments& sizes = arguments.Sizes;
  const auto needsSize = [&arguments](bool isGiven, const char* option)
  {
    refuseIf(
      isGiven && !arguments.hasSizes(), option, "needs a size: --size, --dis, --wl or --slp");
  };
  needsSize(sizes.Least.has_value(), "--min-size");
  needsSize(sizes.Largest.has_value(), "--max-size");
  needsSize(sizes.Gradation.has_value(), "--g");
  needsSize(sizes.Geographic, "--geographic");
  refuseIf(!sizes.Column.empty() && (sizes.Size.empty() || isNumber(sizes.Size)), "--size-column",
    "needs --size with a file");
  refuseIf(sizes.Dis && !sizes.Least, "--dis", "needs --min-size, the size at the shoreline");
  refuseIf(sizes.WaveLength && sizes.Depth.empty(), "--wl", "needs --depth");
  refuseIf(sizes.Slope && sizes.Depth.empty(), "--slp", "needs --depth");
  refuseIf(sizes.Slope && !(sizes.Least && sizes.Largest), "--slp",
    "needs --min-size and --max-size, because a level bottom allows any size");
  refuseIf(sizes.Least && sizes.Largest && *sizes.Least > *sizes.Largest, "--min-size",
    "must not be above --max-size");
}

/// Throws CLI::ValidationError for options that need the whole mesh in memory beside --memory.
void requireFittingMemory(const MeshArguments& arguments)
{
  refuseIf(!arguments.Scratch.empty() && arguments.Memory.empty(), "--scratch", "needs --memory");
  if (arguments.Memory.empty())
  {
    return;
  }
  const auto refuse = [](bool isGiven, const char* option)
  { refuseIf(isGiven, "--memory", std::string("cannot be combined with ") + option); };
  refuseIf(!arguments.KeepOrder, "--memory",
    "needs --keep-order, because to renumber the nodes the whole mesh must be in memory");
  refuse(arguments.SmoothingRounds > 0, "--smooth");
  refuse(!arguments.Sizes.Depth.empty(), "--depth");
  refuse(!arguments.Regions.empty(), "--region");
  refuse(!arguments.RegionFile.empty(), "--regions");
  refuseIf(arguments.OutputIs == Opener::Adcirc || arguments.OutputIs == Opener::Netcdf, "--memory",
    "cannot write " + extensionOf(arguments.Output) +
      ", which needs the whole mesh in memory; name a .vtu, .vtp, .2dm, .msh or .node file");
}

/// Throws CLI::ValidationError for options that would have no effect or contradict each other.
void requireFitting(const MeshArguments& arguments)
{
  refuseIf(arguments.OutputIs == Opener::Npy, "--output",
    "must not be .npy, which does not store the points that are added");
  refuseIf(arguments.KeepBorder && arguments.KeepSegments, "--keep-border",
    "has no effect beside --keep-segments, which also keeps the border");
  requireFittingSizes(arguments);
  requireFittingMemory(arguments);
  const bool hasDepths = !arguments.Sizes.Depth.empty();
  refuseIf(arguments.OpenDepth && !hasDepths, "--open-deeper", "needs --depth");
  refuseIf(arguments.OpenDepth && !arguments.OpenPolygon.empty(), "--open-deeper",
    "cannot be combined with --open");
  refuseIf(arguments.isOpen() && !arguments.hasBoundaryLists(),
    arguments.OpenDepth ? "--open-deeper" : "--open",
    "needs an output named .14, .grd or .gr3, which lists boundaries");
  refuseIf(arguments.DepthsAtNodes && !hasDepths, "--depth-at-nodes", "needs --depth");
  refuseIf(arguments.DepthsAtNodes && !arguments.depthsAreRaster(), "--depth-at-nodes",
    "needs --depth with a raster");
  refuseIf(arguments.Sizes.RasterBounds && !isOpenedBy(arguments.Sizes.Depth, Opener::Npy) &&
      !isOpenedBy(arguments.Sizes.Size, Opener::Npy),
    "--npy-bounds", "needs --size or --depth with an .npy file");
  refuseIf(arguments.Sizes.DepthIsElevation && !hasDepths, "--positive-up", "needs --depth");
  refuseIf(!arguments.Sizes.DepthColumn.empty() && !hasDepths, "--depth-column", "needs --depth");
}

/// Validates a finite number on the command line: returns an error message, or an empty text.
std::string checkFinite(const std::string& text)
{
  const auto value = wholeNumber<double>(text);
  return value && std::isfinite(*value) ? "" : "'" + text + "' is not a number";
}

/// Validates --size on the command line: a path, or a number above 0.
std::string checkSize(const std::string& text)
{
  return isNumber(text) ? checkPositive(text) : std::string();
}

void addShape(CLI::App& command, MeshArguments& arguments)
{
  addChecked(command, "--min-angle", arguments.MinimumAngle,
    CLI::Range(0.0, RefinementOptions::LargestAngle),
    "The smallest angle, in degrees: up to 20.7 proved to end, up to 33 tried");
  command
    .add_option("--max-area", arguments.LargestArea,
      "The largest area of a triangle, in the square of the input's unit")
    ->check(checkPositive);
  command
    .add_option("--region", arguments.Regions,
      "x and y of a point and the largest area of triangles (inf: no further limit) in its part of "
      "the domain, up to the segments around it; may be given several times")
    ->allow_extra_args(false);
  command.add_option("--regions", arguments.RegionFile,
    "A file of such points, after those of --region: a .poly file with areas of regions, or points "
    "with a column area or size");
  command
    .add_option("--hole", arguments.Constraints.Holes,
      "x and y of a point in a hole: there are no triangles up to the segments around it; may be "
      "given several times")
    ->allow_extra_args(false);
  command.add_flag("--convex", arguments.Convex,
    "Mesh the convex hull; otherwise what polygons contain or, without polygons, what lines "
    "enclose");
  command
    .add_option("--min-edge", arguments.ShortestEdge,
      "Make no edge shorter than this; --stats lists what this leaves (default: 2^-36 of the "
      "domain)")
    ->check(checkPositive);
  command.add_option("--max-points", arguments.MostPoints, "Add at most so many points")
    ->check(CLI::PositiveNumber);
  command
    .add_option("--smooth", arguments.SmoothingRounds,
      "Move added points inside the domain towards the mean of their neighbours, where angles grow "
      "and all bounds hold: the number of rounds, or 5 without a number")
    ->expected(0, 1)
    ->default_str("5")
    ->check(CLI::PositiveNumber);
  command.add_flag("--keep-border", arguments.KeepBorder, "Add no points on the border");
  command.add_flag("--keep-segments", arguments.KeepSegments, "Add no points on any segment");
}

void addSizes(CLI::App& command, SizeArguments& sizes)
{
  command
    .add_option("--size", sizes.Size,
      "Length of edges: a number, or a file with lengths: a raster, a mesh or points")
    ->check(checkSize);
  command.add_option("--size-column", sizes.Column, "The column or array of the file of --size");
  command
    .add_option("--dis", sizes.Dis,
      "Let sizes grow by so much per unit of distance from the shoreline, from --min-size on")
    ->check(checkPositive);
  command
    .add_option("--wl", sizes.WaveLength,
      "At least so many edges to a wavelength of the M2 tide; needs --depth")
    ->check(checkPositive);
  command
    .add_option("--slp", sizes.Slope,
      "Let sizes be at most 2 pi depth / (so much x the slope of the bottom); needs --depth")
    ->check(checkPositive);
  command.add_option("--min-size", sizes.Least, "The smallest size")->check(checkPositive);
  command.add_option("--max-size,--max-el", sizes.Largest, "The largest size")
    ->check(checkPositive);
  command
    .add_option("--g,--grade", sizes.Gradation,
      "Let sizes at two places differ by at most so much per unit of distance")
    ->check(checkPositive);
  command.add_flag("--geographic", sizes.Geographic,
    "x and y are degrees of longitude and latitude; sizes are metres, but areas square degrees");
}

void addModel(CLI::App& command, MeshArguments& arguments)
{
  command.add_option("--depth", arguments.Sizes.Depth,
    "A file with depths, of the nodes and for --wl and --slp: a raster or points");
  command.add_option("--depth-column", arguments.Sizes.DepthColumn,
    "The column of the points of --depth (default: depth, or z with --positive-up)");
  command.add_flag("--positive-up", arguments.Sizes.DepthIsElevation,
    "The values of --depth are elevations, positive upwards");
  addBoxOption(command, "--npy-bounds", arguments.Sizes.RasterBounds,
    "The .npy files of --size and --depth are rasters, the lowest row first, with these outer "
    "borders: xmin xmax ymin ymax");
  command.add_flag("--depth-at-nodes", arguments.DepthsAtNodes,
    "Interpolate a raster at the nodes; otherwise a node gets the mean over its cell");
  command.add_option(
    "--open", arguments.OpenPolygon, "A file with polygons: border nodes inside are open boundary");
  command
    .add_option(
      "--open-deeper", arguments.OpenDepth, "Border nodes deeper than this are open boundary")
    ->check(checkFinite);
  command.add_flag("--keep-order", arguments.KeepOrder,
    "Leave the nodes in order, the input's first; otherwise they are renumbered for a low "
    "bandwidth");
}

void addOptions(CLI::App& command, MeshArguments& arguments)
{
  command.add_option("input", arguments.Constraints.Lines, "Lines and polygons, see INPUT below")
    ->required();
  addOutput(command, arguments.Output, "The mesh", Use::WritesTriangles);
  command
    .add_option("--points", arguments.Points,
      "A file of points that must be vertices where they are in the domain; may be given several "
      "times")
    ->allow_extra_args(false);
  command.add_option(
    "--boundary", arguments.Constraints.Boundary, "A file of closed lines: the domain is inside");
  addShape(command, arguments);
  addSizes(command, arguments.Sizes);
  addModel(command, arguments);
  addCurveOption(command);
  command
    .add_option("--memory", arguments.Memory,
      "A memory limit, such as 1G: the mesh is in temporary files, and may be larger than memory")
    ->check(checkRunMemory);
  command.add_option("--scratch", arguments.Scratch,
    "With --memory: a folder for temporary files (default: that of the output)");
  addThreadsOption(command, arguments.Threads);
  command.add_option("--stats", arguments.Statistics,
    "Write figures and the triangles below the bounds to a JSON file");
}

constexpr const char* footer =
  R"(INPUT   .poly (Triangle); .csv, .txt (a segment per line: x and y of both ends); .14,
        .grd, .gr3 (the boundaries of a grid); files of a GIS such as .shp, .gpkg,
        .geojson; any VTK file: lines and polygons. Counter-clockwise polygons are
        the domain, clockwise ones are holes.
OUTPUT  .14, .grd (ADCIRC), .gr3 (SCHISM), .2dm (SMS), .msh (Gmsh), .node with .ele and
        .poly (Triangle), .nc (NetCDF by UGRID), .vtu or .vtp.

The mesh is a constrained Delaunay triangulation that keeps every segment. No angle is
below --min-angle, and no triangle larger than the limits allow: a size h allows the
area of the equilateral triangle with edge h. Where segments meet below 60 degrees,
smaller angles are left; --stats lists each with its reason, and 'tipp check --quality'
proves the rest. The result does not depend on the number of threads, nor on --memory.
With it, the mesh may be larger than memory; it needs --keep-order.

Examples:
  tipp mesh lake.shp -o lake.vtu --max-area 500
  tipp mesh coast.gpkg -o coast.14 --min-size 200 --dis 0.15 --max-size 5000
  tipp mesh bay.shp -o fort.14 --size 100 --depth dem.tif --positive-up --open sea.shp
  tipp mesh coast.gpkg -o coast.vtu --size 20 --keep-order --memory 2G
  tipp mesh part.poly -o fine.node --min-angle 33 --stats fine.json
  tipp check fine.node --quality 33 --constraints part.poly --listed fine.json
)";

int run(MeshArguments& arguments)
{
  arguments.OutputIs = openerOf(arguments.Output, Use::WritesTriangles);
  requireFitting(arguments);
  try
  {
    return isIdleRank() ? Success : runMesh(arguments);
  }
  catch (const WorkAborted&)
  {
    return reportInterrupt();
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(arguments.Constraints.name(), error.what());
  }
  catch (const std::length_error& error)
  {
    throw IOError(arguments.Output, error.what());
  }
}

} // namespace

void addMeshCommand(CLI::App& app, int& exitCode)
{
  addCommand<MeshArguments>(app, exitCode, "mesh",
    "Makes a mesh with good angles and chosen sizes inside lines and polygons", footer, addOptions,
    run);
}

} // namespace tipp
