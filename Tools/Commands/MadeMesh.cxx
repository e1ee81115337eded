// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/MadeMesh.h"

#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Constraints/ReadRegions.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/PagedMemory.h"
#include "InMemory/TriangulateTable.h"
#include "Raster/RasterValues.h"
#include "Refinement/HolePoints.h"
#include "Refinement/MeshPoints.h"
#include "Refinement/NodeOrder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace tipp
{
namespace
{

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

/// Returns the values of a column at all points of the mesh, in `memory`.
Buffer<double> extended(const PointsMesh& mesh, std::vector<double>&& values, PagedMemory* memory)
{
  Buffer<double> all = bufferIn<double>(memory, values.size() + mesh.Blends.size());
  double* to = std::copy(values.begin(), values.end(), all.begin());
  values = {};
  constexpr std::size_t often = 1 << 15;
  for (std::size_t i = 0; i < mesh.Blends.size(); ++i)
  {
    if (i % often == 0)
    {
      keepMemoryLimits();
    }
    *to++ = mesh.Blends[i].valueOf([&all](PointId id) { return all[std::size_t(id)]; });
  }
  return all;
}

/// Appends the points that the mesh has beyond those of the table, with interpolated columns.
void appendPoints(const PointsMesh& mesh, PointTable& points)
{
  points.XY.insert(points.XY.end(), mesh.NewXY.begin(), mesh.NewXY.end());
  for (PointTable::Column& column : points.Columns)
  {
    for (const PointBlend& blend : mesh.Blends)
    {
      column.Values.push_back(
        blend.valueOf([&column](PointId id) { return column.Values[std::size_t(id)]; }));
    }
  }
}

/// Of the first `Width`-tuples of an array, keeps those whose number is not negative, and all
/// others. Returns the number of values.
template <std::size_t Width>
std::size_t keepRows(const std::vector<std::int64_t>& numbers, double* values, std::size_t size)
{
  std::size_t end = 0;
  for (std::size_t row = 0; row < size / Width; ++row)
  {
    if (row >= numbers.size() || numbers[row] >= 0)
    {
      std::copy_n(values + Width * row, Width, values + end);
      end += Width;
    }
  }
  return end;
}

/// Keeps the points whose number is not negative, and those that have none.
void keepPoints(const std::vector<std::int64_t>& numbers, MadeMesh& made)
{
  std::vector<double>& xy = made.Points.XY;
  xy.resize(keepRows<2>(numbers, xy.data(), xy.size()));
  for (PointTable::Column& column : made.Points.Columns)
  {
    std::vector<double>& values = column.Values;
    values.resize(keepRows<1>(numbers, values.data(), values.size()));
  }
  for (Buffer<double>& values : made.Columns)
  {
    values.truncate(keepRows<1>(numbers, values.data(), values.size()));
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
    keepPoints(numbers, made);
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
  if (missing == std::int64_t(made.nodeCount()))
  {
    throw IOError(path,
      "has no depth at any node; give a file of the same area, in the same reference system.");
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

/// Computes the depths of the nodes, which replace a column of this name. Throws IOError.
void addDepths(const MeshArguments& arguments, PagedMemory* memory, MadeMesh& made)
{
  const std::string& path = arguments.Sizes.Depth;
  const std::optional<Box2>& bounds = arguments.Sizes.RasterBounds;
  NodeDepthOptions options;
  options.Axis = arguments.Sizes.DepthIsElevation ? VerticalAxis::Elevations : VerticalAxis::Depths;
  options.Threads = arguments.Threads;
  options.Memory = memory;
  if (arguments.depthsAreRaster())
  {
    const auto raster =
      isOpenedBy(path, Opener::Npy) ? openNpyRaster(path, *bounds) : openRasterValues(path);
    made.Depths = depthsFromRaster(made.nodes(), viewOf(made), *raster,
      arguments.DepthsAtNodes ? NodeRule::AtNode : NodeRule::CellMean, options);
  }
  else
  {
    const auto points = openPointStream({ path }, {});
    const std::string column = !arguments.Sizes.DepthColumn.empty() ? arguments.Sizes.DepthColumn
      : arguments.Sizes.DepthIsElevation                            ? "z"
                                                                    : "depth";
    requireColumn(path, points->columns(), column);
    made.Depths = depthsFromPoints(made.nodes(), viewOf(made), *points, column, options);
  }
  checkDepths(arguments, made);
}

/// The closed lines of a boundary, without repeated corners. Its edges may come in any order and
/// direction, because an even number of them ends at each position, compared by x and y.
std::vector<std::vector<Point2>> ringsOf(const ConstraintTable& table)
{
  using Position = std::pair<double, double>;
  const auto positionOf = [&table](std::int64_t id) {
    return Position{ table.XY[2 * std::size_t(id)], table.XY[2 * std::size_t(id) + 1] };
  };
  std::map<Position, std::vector<std::size_t>> edgesAt;
  for (std::size_t edge = 0; edge < table.Edges.size(); ++edge)
  {
    edgesAt[positionOf(table.Edges[edge][0])].push_back(edge);
    edgesAt[positionOf(table.Edges[edge][1])].push_back(edge);
  }
  std::vector<bool> isUsed(table.Edges.size(), false);
  const auto takeEdge = [&](const Position& at)
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
    Position at = positionOf(first[0]);
    for (std::size_t edge = takeEdge(at); edge < table.Edges.size(); edge = takeEdge(at))
    {
      isUsed[edge] = true;
      ring.push_back({ at.first, at.second });
      const Position end = positionOf(table.Edges[edge][0]);
      at = end == at ? positionOf(table.Edges[edge][1]) : end;
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
    return nodesDeeperThan(made.Depths->Values.data(), *arguments.OpenDepth);
  }
  if (arguments.OpenPolygon.empty())
  {
    return [](std::int64_t) { return false; };
  }
  return nodesInside(made.nodes(), ringsOf(readBoundary(arguments.OpenPolygon)));
}

void findBoundaries(const MeshArguments& arguments, MadeMesh& made)
{
  const LandKinds ofSchism{ 0, 1 };
  made.Boundaries = findModelBoundaries(made.nodes(), viewOf(made), openNodesOf(arguments, made),
    extensionOf(arguments.Output) == ".gr3" ? ofSchism : LandKinds(), made.Segments);
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

/// Takes the nodes over from a mesh: in `memory`, unless that is null, only the crossings become
/// rows of the table.
void takeNodes(PointsMesh& mesh, PagedMemory* memory, MadeMesh& made)
{
  if (!memory)
  {
    appendPoints(mesh, made.Points);
    return;
  }
  made.InTable = std::size_t(mesh.Crossings);
  std::vector<double>& xy = made.Points.XY;
  xy.insert(xy.end(), mesh.NewXY.begin(), mesh.NewXY.begin() + 2 * made.InTable);
  made.NewXY = std::move(mesh.NewXY);
  for (PointTable::Column& column : made.Points.Columns)
  {
    made.Columns.push_back(extended(mesh, std::move(column.Values), memory));
  }
}

/// Takes the nodes, triangles and segments over from a mesh.
void takeMesh(PointsMesh&& mesh, PagedMemory* memory, MadeMesh& made)
{
  takeNodes(mesh, memory, made);
  made.Triangles = std::move(mesh.Mesh.Triangles);
  made.Regions = std::move(mesh.Mesh.RegionOf);
  for (const IdSegment& segment : mesh.Mesh.Segments)
  {
    made.Segments.push_back({ segment.A, segment.B });
  }
  made.Refined = std::move(mesh.Mesh);
  made.LeftOut = removeUnused(made.Refined.IsUsed, made);
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

} // namespace

bool makeMesh(const MeshArguments& arguments, PagedMemory* memory, MadeMesh& made)
{
  SourceConstraints source;
  made.Points = readInput(arguments, source);
  made.GivenPoints = std::int64_t(made.Points.size());
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
  takeMesh(std::move(mesh), memory, made);
  return true;
}

NodesView MadeMesh::nodes() const
{
  std::vector<NodeColumn> columns;
  for (std::size_t i = 0; i < this->Points.Columns.size(); ++i)
  {
    const PointTable::Column& column = this->Points.Columns[i];
    if (!this->Depths || column.Name != "depth")
    {
      columns.push_back(
        { column.Name, this->Columns.empty() ? column.Values.data() : this->Columns[i].data() });
    }
  }
  if (this->Depths)
  {
    columns.push_back({ "depth", this->Depths->Values.data() });
  }
  return { this->Points, this->NewXY.data() + 2 * this->InTable,
    this->NewXY.size() / 2 - this->InTable, std::move(columns) };
}

void completeMesh(const MeshArguments& arguments, PagedMemory* memory, MadeMesh& made)
{
  made.Bandwidth = bandwidthOf(made);
  if (!arguments.KeepOrder)
  {
    orderNodes(made);
  }
  if (!arguments.Sizes.Depth.empty())
  {
    addDepths(arguments, memory, made);
  }
  if (arguments.hasBoundaryLists())
  {
    findBoundaries(arguments, made);
  }
}

bool writeMade(const MeshArguments& arguments, const MadeMesh& made, const PathState& before)
{
  MeshOptions options;
  options.Before = before;
  options.Aborted = isInterrupted;
  options.Regions = { made.Regions.data(), made.Regions.size() };
  options.Boundaries = made.Boundaries.Lists;
  options.Segments = made.Segments;
  options.Crs = arguments.Sizes.Geographic ? "EPSG:4326" : "";
  if (arguments.OutputIs == Opener::Triangle)
  {
    options.Holes = holesOf(made);
  }
  return writeMesh(arguments.Output, made.nodes(), viewOf(made), options);
}

} // namespace tipp
