// SPDX-License-Identifier: BSD-3-Clause
#include "Check/AngleBound.h"
#include "Check/DelaunayChecker.h"
#include "Commands/CheckQuality.h"
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Meshes/MeshFiles.h"
#include "Parallel/Sort.h"
#include "Partitioned/FinishedPieces.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/ReadPiece.h"
#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* meshFormats =
  "The triangles: .npy (m x 3 integers), .14, .grd, .gr3, .2dm, .msh, .node or .ele, a VTK file or "
  "a partitioned mesh; or tetrahedra: .npy (m x 4 integers), .vtu or a partitioned mesh";

constexpr const char* footer =
  R"(The check is exact and computes no triangulation of its own. It requires: every edge is in
at most two triangles, all triangles are counter-clockwise, every interior edge is locally
Delaunay, the boundary is one convex chain, the number of triangles follows Euler's formula,
and every distinct point is a vertex. If the mesh has the cell array NeighborIds, the two
triangles of every edge must store each other. A partitioned mesh is read piece by piece
and may be larger than memory. Exit codes: 0: proved to be correct; 1: faults, or a file that
cannot be read; 2: wrong usage; 3: cannot decide.

With --constraints, the constraints' edges need not be locally Delaunay, and the mesh may
have more points after the given ones. A constraint is a chain of edges through points that
it passes exactly, or of ends and crossings to which points of it round. Where only several
roundings could explain a chain, the check may be unable to decide: this is no fault. With --cut, or if the constraints have polygons or
holes, each boundary edge must be an edge of a constraint or of the convex hull, and
constraints may lie outside of the mesh. Whether the right triangles were removed is not
checked.

Tetrahedra are checked in the same way, in memory.

With --quality, the mesh is a refined one: it may have any further points, and segments are
chains of edges through points that were split off in double precision. Each segment must be
such a chain wherever it is inside of the mesh, the border consists of segments or edges of
the input's convex hull, the input's points are vertices unless they are outside, and the
bounds hold. A triangle below the angle is excused if its shortest edge joins two segments
that meet at less than 60 degrees, or with --listed as the list says; an entry 'input angle'
must be of this kind. The input is POINTS, if given, and what --constraints holds.

Examples:
  tipp check points.npy triangles.npy
  tipp check survey.csv --x easting --y northing mesh.vtp --tie-rule
  tipp check fort.14 fort.14 --boundary-free
  tipp check points.npy mesh.tipp
  tipp check survey.csv survey.vtp --constraints breaklines.vtp --tie-rule
  tipp check particles.npy tetrahedra.vtu --tie-rule
  tipp check mesh.vtu --quality 30 --max-area 0.1 --constraints lake.poly
  tipp check bay.14 --quality 30 --size sizes.tif --constraints bay.shp --listed bay.json
)";

/// The options of `tipp check`.
struct CheckArguments
{
  std::string Points;
  std::string Mesh;
  PointOptions Columns;
  std::vector<std::string> Constraints; ///< paths of files
  CheckOptions Options;
  QualityArguments Quality; ///< what is checked if its MinAngle is not empty

  /// Returns whether the mesh lacks triangles: with --cut, or if there are polygons or holes.
  bool isCutBy(const ConstraintTable& table) const
  {
    return this->Options.IsCut || table.PolygonBegin < table.Edges.size() || !table.Holes.empty();
  }
};

/// Returns whether the mesh is partitioned: only such a mesh is a folder. If its index is missing,
/// opening it says so.
bool isStoredInPieces(const std::string& mesh)
{
  std::error_code ignored;
  return isPartitionedMesh(mesh) || std::filesystem::is_directory(mesh, ignored);
}

/// Throws IOError: the mesh stores `found` points other than the `points` points of the input.
[[noreturn]] void refuseOtherPoints(
  const CheckArguments& arguments, std::size_t found, std::size_t points)
{
  throw IOError(arguments.Mesh,
    fmt::format("its {} points are not the {} points of {}; check it against the points that it "
                "was made from.",
      found, points, arguments.Points));
}

bool isSameNumber(double a, double b)
{
  return a == b || (a != a && b != b);
}

/// Throws IOError if the mesh stores points (`stored` is not empty) and they are not the input's
/// `points`. NaN equals NaN here. Both arrays hold `dimension` coordinates of each point.
void requireSamePoints(const CheckArguments& arguments, const std::vector<double>& points,
  const std::vector<double>& stored, std::size_t dimension)
{
  if (!stored.empty() &&
    !std::equal(points.begin(), points.end(), stored.begin(), stored.end(), isSameNumber))
  {
    refuseOtherPoints(arguments, stored.size() / dimension, points.size() / dimension);
  }
}

/// Returns the constraints as indices of the mesh's points: the first one with equal coordinates,
/// or -1. Constraints whose ends are not finite are left out.
std::vector<std::array<std::int64_t, 2>> constraintsAmong(
  const std::vector<double>& xy, const ConstraintTable& table)
{
  if (table.XY.empty())
  {
    return table.Edges;
  }
  const auto pointAt = [](const std::vector<double>& from, std::int64_t i) {
    return std::array<double, 2>{ from[2 * std::size_t(i)], from[2 * std::size_t(i) + 1] };
  };
  const auto isGood = [](const std::array<double, 2>& p) { return isFinite(Point2{ p[0], p[1] }); };
  std::map<std::array<double, 2>, std::int64_t> indices; // NaN has no order
  for (std::int64_t i = 0; i < std::int64_t(xy.size() / 2); ++i)
  {
    const auto point = pointAt(xy, i);
    if (isGood(point))
    {
      indices.emplace(point, i);
    }
  }
  const auto indexOf = [&indices](const std::array<double, 2>& p)
  {
    const auto found = indices.find(p);
    return found == indices.end() ? -1 : found->second;
  };
  std::vector<std::array<std::int64_t, 2>> constraints;
  for (const auto& edge : table.Edges)
  {
    const auto first = pointAt(table.XY, edge[0]);
    const auto last = pointAt(table.XY, edge[1]);
    if (isGood(first) && isGood(last))
    {
      constraints.push_back({ indexOf(first), indexOf(last) });
    }
  }
  return constraints;
}

/// `given`: the number of input points, which have the lowest ids.
ConstraintsInMesh constraintsInMesh(std::vector<std::array<std::int64_t, 2>> constraints,
  std::int64_t given, const CheckOptions& options)
{
  return { std::move(constraints), [given](std::int64_t id) { return id >= given; }, options.IsCut,
    options.TieRule };
}

void addChains(CheckReport& report, const ConstraintChains& chains)
{
  report.LostConstraints = chains.Lost;
  report.UndecidedConstraints = chains.UndecidedConstraints;
  report.UndecidedEdges = chains.UndecidedEdges;
}

/// Checks a mesh with constraints, whose first points are the input points.
CheckReport checkConstrained(
  const CheckArguments& arguments, std::vector<double>& points, TriangleMesh& mesh)
{
  std::vector<double>& xy = mesh.XY.empty() ? points : mesh.XY;
  if (xy.size() < points.size() ||
    !std::equal(points.begin(), points.end(), xy.begin(), isSameNumber))
  {
    throw IOError(arguments.Mesh,
      fmt::format("its first {} points are not those of {}; check it against the points that it "
                  "was made from.",
        points.size() / 2, arguments.Points));
  }
  const ConstraintTable table = readConstraintFiles(arguments.Constraints, arguments.Columns.Wrap);
  std::vector<std::array<std::int64_t, 2>> constraints = constraintsAmong(xy, table);
  const std::int64_t count = std::int64_t(xy.size() / 2);
  const auto lost = std::remove_if(constraints.begin(), constraints.end(),
    [count](const auto& ids)
    { return std::min(ids[0], ids[1]) < 0 || std::max(ids[0], ids[1]) >= count; });
  const std::int64_t missing = constraints.end() - lost;
  constraints.erase(lost, constraints.end());
  CheckOptions options = arguments.Options;
  options.IsCut = arguments.isCutBy(table);
  ConstraintChains chains = findConstraintChains(xy, mesh.Triangles,
    constraintsInMesh(std::move(constraints), std::int64_t(points.size() / 2), options));
  options.Constraints = std::move(chains.Edges);
  CheckReport report =
    checkDelaunay(std::move(xy), std::move(mesh.Triangles), options, std::move(mesh.Neighbors));
  chains.Lost += missing;
  addChains(report, chains);
  return report;
}

CheckReport checkTriangles(const CheckArguments& arguments)
{
  std::vector<double> xy = readPoints(arguments.Points, arguments.Columns).XY;
  TriangleMesh mesh = readMesh(arguments.Mesh);
  if (!arguments.Constraints.empty())
  {
    return checkConstrained(arguments, xy, mesh);
  }
  requireSamePoints(arguments, xy, mesh.XY, 2);
  mesh.XY = {};
  return checkDelaunay(
    std::move(xy), std::move(mesh.Triangles), arguments.Options, std::move(mesh.Neighbors));
}

/// Returns the options to read a piece with the array NeighborIds, if there is one, and no other.
PieceOptions withNeighborsOnly(const PartitionedMesh& mesh)
{
  PieceOptions options;
  options.Wanted.assign(mesh.Arrays.size(), false);
  const std::int64_t neighborIds = findNeighborIds(mesh);
  if (neighborIds >= 0)
  {
    options.Wanted[std::size_t(neighborIds)] = true;
  }
  return options;
}

CheckedPiece readChecked(const PartitionedMesh& mesh, std::size_t number)
{
  Piece piece = readPiece(mesh, number, withNeighborsOnly(mesh));
  CheckedPiece checked;
  const auto points = std::size_t(piece.Points);
  checked.XY.resize(2 * points);
  for (std::size_t i = 0; i < points; ++i)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      checked.XY[2 * i + axis] = piece.PointType == Scalar::Float64
        ? piece.Coordinates.as<double>()[3 * i + axis]
        : double(piece.Coordinates.as<float>()[3 * i + axis]);
    }
  }
  piece.Coordinates = {};
  const auto* ids = piece.PointIds.as<std::int64_t>();
  checked.Ids.assign(ids, ids + points);
  const auto* ghosts = piece.PointGhosts.as<std::uint8_t>();
  for (std::size_t i = 0; i < points; ++i)
  {
    checked.IsOwn.push_back(ghosts[i] == 0);
  }
  checked.Triangles.reserve(3 * std::size_t(piece.Cells));
  for (std::int64_t cell = 0; cell < piece.Cells; ++cell)
  {
    for (int i = 0; i < 3; ++i)
    {
      checked.Triangles.push_back(piece.corner(cell, i));
    }
  }
  checked.OwnTriangles = piece.OwnedCells;
  if (!piece.Attributes.empty())
  {
    const auto* cells = piece.CellIds.as<std::int64_t>();
    checked.CellIds.assign(cells, cells + piece.OwnedCells);
    const auto* neighbors = piece.Attributes[0].Values.as<std::int64_t>();
    checked.Neighbors.assign(neighbors, neighbors + 3 * piece.OwnedCells);
  }
  return checked;
}

struct InputSum
{
  std::int64_t All = 0;
  std::int64_t Points = 0; ///< points with finite coordinates
  std::uint64_t Sum = 0;
};

/// Sums the input points. If the table's edges are ids of input points, reads these points'
/// coordinates into the table.
InputSum readInput(const CheckArguments& arguments, ConstraintTable& table)
{
  std::vector<std::int64_t> named;
  for (std::size_t i = 0; table.XY.empty() && i < table.Edges.size(); ++i)
  {
    named.insert(named.end(), table.Edges[i].begin(), table.Edges[i].end());
  }
  sortUnique(named);
  table.XY.resize(table.XY.size() + 2 * named.size(), std::nan(""));
  InputSum input;
  constexpr std::size_t blockPoints = 1 << 18;
  const auto stream = openPointStream({ arguments.Points }, arguments.Columns);
  forEachBlock(*stream, blockPoints,
    [&](PointBlock& block)
    {
      input.All += std::int64_t(block.size());
      for (std::size_t i = 0; i < block.size(); ++i)
      {
        const double x = block.XY[2 * i];
        const double y = block.XY[2 * i + 1];
        if (isFinite(Point2{ x, y }))
        {
          ++input.Points;
          input.Sum += PieceChecker::hashPoint(block.First + std::int64_t(i), x, y);
        }
      }
      auto id = std::lower_bound(named.begin(), named.end(), block.First);
      for (; id != named.end() && *id < input.All; ++id)
      {
        const auto from = block.XY.begin() + 2 * std::ptrdiff_t(*id - block.First);
        std::copy_n(from, 2, table.XY.begin() + 2 * (id - named.begin()));
      }
    });
  for (std::size_t i = 0; !named.empty() && i < table.Edges.size(); ++i)
  {
    for (std::int64_t& id : table.Edges[i])
    {
      id = std::lower_bound(named.begin(), named.end(), id) - named.begin();
    }
  }
  return input;
}

/// Checks the triangles of a partitioned mesh against points that are read block by block. One
/// piece at a time and the triangles near constraints are in memory. Throws IOError if a file
/// cannot be read, or if the mesh was made from other points.
CheckReport checkPartitioned(const CheckArguments& arguments)
{
  const PartitionedMesh mesh = openPartitionedMesh(arguments.Mesh);
  verifyViews(mesh);
  CheckOptions options = arguments.Options;
  ConstraintChains chains;
  ConstraintTable table;
  if (!arguments.Constraints.empty())
  {
    table = readConstraintFiles(arguments.Constraints, arguments.Columns.Wrap);
  }
  const InputSum input = readInput(arguments, table);
  if (!arguments.Constraints.empty())
  {
    options.IsCut = arguments.isCutBy(table);
    chains = findConstraintChains(
      mesh.Pieces.size(), [&mesh](std::size_t number) { return readChecked(mesh, number); },
      table.XY, constraintsInMesh(table.Edges, input.All, options));
    options.Constraints = std::move(chains.Edges);
  }
  PieceChecker checker(
    options, arguments.Constraints.empty() ? std::numeric_limits<std::int64_t>::max() : input.All);
  {
    ProgressBar bar("Checking");
    for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
    {
      readUnchanged(mesh, [&] { PieceFile(mesh, number).verifyAll(); });
      checker.add(readChecked(mesh, number));
      bar.update(double(number + 1) / double(mesh.Pieces.size()));
    }
  }
  CheckReport report = checker.finish();
  addChains(report, chains);
  if (input.Points != checker.givenPoints() || input.Sum != checker.pointSum())
  {
    refuseOtherPoints(arguments, std::size_t(checker.givenPoints()), std::size_t(input.Points));
  }
  return report;
}

/// Reads the tetrahedra of a partitioned mesh. Throws IOError unless its points are the finite ones
/// among `xyz`.
StoredTetrahedra readPieces(const CheckArguments& arguments, const std::vector<double>& xyz)
{
  const PartitionedMesh mesh = openPartitionedMesh(arguments.Mesh);
  verifyViews(mesh);
  StoredTetrahedra stored;
  const PieceOptions options = withNeighborsOnly(mesh);
  std::size_t found = 0;
  bool areSame = true;
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    readUnchanged(mesh, [&] { PieceFile(mesh, number).verifyAll(); });
    const Piece piece = readPiece(mesh, number, options);
    const auto* ids = piece.PointIds.as<std::int64_t>();
    const auto* ghosts = piece.PointGhosts.as<std::uint8_t>();
    const auto* at = piece.Coordinates.as<double>();
    for (std::int64_t i = 0; i < piece.Points; ++i)
    {
      const bool isOwn = ghosts[i] == 0;
      found += isOwn ? 1 : 0;
      areSame = areSame && piece.PointType == Scalar::Float64 && ids[i] >= 0 &&
        ids[i] < std::int64_t(xyz.size() / 3) &&
        std::equal(at + 3 * i, at + 3 * i + 3, xyz.begin() + 3 * ids[i]);
    }
    for (std::int64_t cell = 0; areSame && cell < piece.OwnedCells; ++cell)
    {
      for (int corner = 0; corner < 4; ++corner)
      {
        stored.Ids.push_back(ids[piece.corner(cell, corner)]);
      }
    }
    if (!piece.Attributes.empty())
    {
      const auto* neighbors = piece.Attributes[0].Values.as<std::int64_t>();
      stored.Neighbors.insert(stored.Neighbors.end(), neighbors, neighbors + 4 * piece.OwnedCells);
    }
  }
  std::size_t finite = 0;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
  {
    finite += std::isfinite(xyz[i]) && std::isfinite(xyz[i + 1]) && std::isfinite(xyz[i + 2]);
  }
  if (!areSame || found != finite)
  {
    refuseOtherPoints(arguments, found, finite);
  }
  return stored;
}

/// Checks tetrahedra in memory. Throws IOError if a file cannot be read, or if the mesh was made
/// from other points.
CheckReport checkInSpace(const CheckArguments& arguments)
{
  PointOptions columns = arguments.Columns;
  columns.InSpace = true;
  const PointTable table = readAllPoints(*openPointStream({ arguments.Points }, columns));
  const std::vector<double>& z = table.Columns[requireElevation(table, arguments.Points)].Values;
  std::vector<double> xyz;
  xyz.reserve(3 * table.size());
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    xyz.insert(xyz.end(), { table.XY[2 * i], table.XY[2 * i + 1], z[i] });
  }
  const StoredTetrahedra stored =
    isStoredInPieces(arguments.Mesh) ? readPieces(arguments, xyz) : readTetrahedra(arguments.Mesh);
  requireSamePoints(arguments, xyz, stored.XYZ, 3);
  return checkTetrahedra(xyz, stored.Ids, arguments.Options.TieRule, stored.Neighbors);
}

/// The mesh is the last of the files, the input's points the one before it.
int runQuality(const CheckArguments& arguments)
{
  QualityArguments quality = arguments.Quality;
  const bool isNpy = !quality.Size.empty() && isOpenedBy(quality.Size, Opener::Npy);
  refuseIf(quality.RasterBounds && !isNpy, "--npy-bounds", "needs --size with an .npy file");
  refuseIf(isNpy && !quality.RasterBounds, "--size",
    "has an .npy file, which does not say where it lies; give --npy-bounds");
  refuseIf(quality.LeastSize && quality.LargestSize && *quality.LeastSize > *quality.LargestSize,
    "--min-size", "must not be above --max-size");
  quality.Points = arguments.Mesh.empty() ? "" : arguments.Points;
  quality.Mesh = arguments.Mesh.empty() ? arguments.Points : arguments.Mesh;
  quality.Constraints = arguments.Constraints;
  quality.Columns = arguments.Columns;
  return checkQualityOfFiles(quality);
}

int runCheck(const CheckArguments& arguments)
{
  if (!arguments.Quality.MinAngle.empty())
  {
    return runQuality(arguments);
  }
  if (arguments.Mesh.empty())
  {
    throw CLI::RequiredError("mesh");
  }
  const bool isPartitioned = isStoredInPieces(arguments.Mesh);
  const bool inSpace = isPartitioned ? openPartitionedMesh(arguments.Mesh).CellSize == 4
                                     : holdsTetrahedra(arguments.Mesh);
  const CheckReport report = inSpace ? checkInSpace(arguments)
    : isPartitioned                  ? checkPartitioned(arguments)
                                     : checkTriangles(arguments);
  fmt::print("{} points ({} distinct), {} {}, {} {}, {} {} ties: {}\n", report.Points,
    report.DistinctPoints, report.Cells, inSpace ? "tetrahedra" : "triangles",
    report.BoundaryFacets, inSpace ? "hull facets" : "boundary edges", report.Ties,
    inSpace ? "co-spherical" : "co-circular",
    report.isCorrect()          ? "correct"
      : report.faults().empty() ? "cannot decide"
                                : "FAULTY");
  for (const auto& lines : { report.faults(), report.undecided() })
  {
    for (const std::string& line : lines)
    {
      fmt::print("  {}\n", line);
    }
  }
  return report.isCorrect() ? Success : report.faults().empty() ? Undecided : Failure;
}

/// Validates an angle on the command line: returns an error message, or an empty text.
std::string checkAngle(const std::string& text)
{
  try
  {
    const check::AngleBound parsed(text);
    return {};
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
}

/// Adds --size and the options that go with it. `angle`: the option --quality.
void addSizeOptions(CLI::App& command, QualityArguments& quality, CLI::Option* angle)
{
  CLI::Option* const size = command.add_option("--size", quality.Size,
    "With --quality: the length of edges: a number, or a raster. No triangle may be larger than "
    "the equilateral one with this edge");
  size->check(
    [](const std::string& text)
    {
      return text.empty()           ? "is empty; give a number or a raster"
        : wholeNumber<double>(text) ? checkPositive(text)
                                    : std::string();
    });
  size->needs(angle);
  command.add_option("--min-size", quality.LeastSize, "As of 'tipp mesh': the smallest size")
    ->check(checkPositive)
    ->needs(size);
  command
    .add_option("--max-size,--max-el", quality.LargestSize, "As of 'tipp mesh': the largest size")
    ->check(checkPositive)
    ->needs(size);
  command
    .add_flag("--geographic", quality.Geographic,
      "x and y are degrees of longitude and latitude, and sizes are metres")
    ->needs(size);
  addBoxOption(command, "--npy-bounds", quality.RasterBounds,
    "The .npy file of --size is a raster, the lowest row first, with these outer borders: xmin "
    "xmax ymin ymax")
    ->needs(size);
}

/// Adds --quality and the options that need it. `others` mean nothing with it.
void addQualityOptions(
  CLI::App& command, QualityArguments& quality, const std::vector<CLI::Option*>& others)
{
  CLI::Option* const angle = command.add_option("--quality", quality.MinAngle,
    "Check a refined mesh, which may have any points besides those of the input: its angles must "
    "be at least as large, in degrees from 0 to 60");
  angle->check(checkAngle);
  for (CLI::Option* const other : others)
  {
    angle->excludes(other);
  }
  command
    .add_option(
      "--max-area", quality.MaxArea, "With --quality: the largest area that a triangle may have")
    ->check(checkPositive)
    ->needs(angle);
  command
    .add_option("--listed", quality.Listed,
      "With --quality: the file of 'tipp mesh --stats', whose list below_bound must have all "
      "triangles with an angle below the bound, each with its angle and the reason, and its list "
      "above_area all that are larger than allowed")
    ->needs(angle);
  addSizeOptions(command, quality, angle);
}

void addOptions(CLI::App& command, CheckArguments& arguments)
{
  command
    .add_option("points", arguments.Points,
      "The points, in any format of 'tipp delaunay'; with --quality they may be left out")
    ->required();
  command.add_option("mesh", arguments.Mesh, meshFormats);
  addPointOptions(command, arguments.Columns);
  addBoundsOption(command, arguments.Columns);
  CLI::Option* const tieRule = command.add_flag("--tie-rule", arguments.Options.TieRule,
    "Also check that ties between co-circular points are broken by the points' lexicographic "
    "order, which makes the triangulation unique");
  CLI::Option* const boundaryFree =
    command.add_flag("--boundary-free", arguments.Options.BoundaryFree,
      "The mesh need not fill the convex hull: do not check its boundary and Euler's formula");
  command
    .add_option("--constraints", arguments.Constraints,
      "The file of constraints that the mesh was made with, which may have more points after the "
      "given ones. May be given several times")
    ->allow_extra_args(false);
  addCurveOption(command);
  CLI::Option* const cut = command.add_flag("--cut", arguments.Options.IsCut,
    "With --constraints: the mesh lacks triangles outside of polygons or in holes");
  addQualityOptions(command, arguments.Quality, { tieRule, boundaryFree, cut });
}

} // namespace

void addCheckCommand(CLI::App& app, int& exitCode)
{
  addCommand<CheckArguments>(app, exitCode, "check",
    "Checks that triangles are the Delaunay triangulation of points, exactly", footer, addOptions,
    [](CheckArguments& arguments) { return isIdleRank() ? Success : runCheck(arguments); });
}

} // namespace tipp
