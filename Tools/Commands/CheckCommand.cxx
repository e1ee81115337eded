// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/SortUnique.h"
#include "Check/ConstraintChains.h"
#include "Check/DelaunayChecker.h"
#include "Check/PieceChecker.h"
#include "Commands/CheckTetrahedra.h"
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Console/Process.h"
#include "Console/ProgressBar.h"
#include "Constraints/ReadConstraintFile.h"
#include "Files/IOError.h"
#include "Meshes/MeshFiles.h"
#include "Partitioned/NeighborIds.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Points/PointStream.h"
#include "Points/ReadPoints.h"
#include "Predicates/Points.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <unordered_map>

namespace tipp
{
namespace
{

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
  if (piece.WideIds)
  {
    throw IOError(
      mesh.piecePath(number), "has more than 2^31 points or corners; partition it more finely.");
  }
  const auto* corners = piece.Connectivity.as<std::int32_t>();
  checked.Triangles.assign(corners, corners + 3 * piece.Cells);
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

InputSum sumInput(const std::string& path, const PointOptions& columns)
{
  InputSum input;
  constexpr std::size_t blockPoints = 1 << 18;
  const auto stream = openPointStream({ path }, columns);
  forEachBlock(*stream, blockPoints,
    [&](PointBlock& block)
    {
      input.All += std::int64_t(block.size());
      for (std::size_t i = 0; i < block.size(); ++i)
      {
        const double x = block.XY[2 * i];
        const double y = block.XY[2 * i + 1];
        if (isFinite({ x, y }))
        {
          ++input.Points;
          input.Sum += PieceChecker::hashPoint(block.First + std::int64_t(i), x, y);
        }
      }
    });
  return input;
}

struct CheckArguments
{
  std::string Points;
  std::string Mesh;
  PointOptions Columns;
  std::string Constraints; ///< path of a file; empty: none
  CheckOptions Options;
};

/// If the table's edges are ids of input points, reads these points' coordinates into the table.
void takePositions(const CheckArguments& arguments, ConstraintTable& table)
{
  if (!table.XY.empty())
  {
    return;
  }
  std::vector<std::int64_t> named;
  for (const auto& edge : table.Edges)
  {
    named.insert(named.end(), edge.begin(), edge.end());
  }
  sortUnique(named);
  table.XY.assign(2 * named.size(), std::nan(""));
  constexpr std::size_t blockPoints = 1 << 18;
  const auto stream = openPointStream({ arguments.Points }, arguments.Columns);
  forEachBlock(*stream, blockPoints,
    [&](PointBlock& block)
    {
      auto id = std::lower_bound(named.begin(), named.end(), block.First);
      for (; id != named.end() && *id < block.First + std::int64_t(block.size()); ++id)
      {
        const auto from = block.XY.begin() + 2 * std::ptrdiff_t(*id - block.First);
        std::copy_n(from, 2, table.XY.begin() + 2 * (id - named.begin()));
      }
    });
  for (auto& edge : table.Edges)
  {
    for (std::int64_t& id : edge)
    {
      id = std::lower_bound(named.begin(), named.end(), id) - named.begin();
    }
  }
}

/// Finds the constraints' edges in the mesh; returns them by global ids. Keeps in memory only
/// triangles near constraints: those with an edge on one, or in a cut mesh all those at vertices on
/// constraints, which show its border there.
ConstraintChains findChains(const PartitionedMesh& mesh, const ConstraintTable& table, bool isCut)
{
  const NearConstraints near(table.XY, table.Edges);
  std::vector<double> xy;
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> triangles;
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    const CheckedPiece piece = readChecked(mesh, number);
    const auto at = [&piece](std::int32_t point)
    {
      const auto i = 2 * std::size_t(point);
      return check::Position{ piece.XY.at(i), piece.XY.at(i + 1) };
    };
    std::unordered_map<std::int32_t, std::int64_t> known;
    for (std::size_t t = 0; t < 3 * std::size_t(piece.OwnTriangles); t += 3)
    {
      const std::int32_t* const corners = &piece.Triangles[t];
      bool isNear = false;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const check::Position from = at(corners[i]);
        isNear = isNear || near.mayHave(from, isCut ? from : at(corners[(i + 1) % 3]));
      }
      for (std::size_t i = 0; isNear && i < 3; ++i)
      {
        const auto [found, isNew] = known.emplace(corners[i], std::int64_t(ids.size()));
        if (isNew)
        {
          xy.insert(xy.end(), { at(corners[i]).x, at(corners[i]).y });
          ids.push_back(piece.Ids[std::size_t(corners[i])]);
        }
        triangles.push_back(found->second);
      }
    }
  }
  // A point may be in several pieces. The first one with its coordinates represents all.
  std::map<std::pair<double, double>, std::int64_t> positions;
  for (std::int64_t& corner : triangles)
  {
    const auto i = 2 * std::size_t(corner);
    corner = positions.emplace(std::make_pair(xy[i], xy[i + 1]), corner).first->second;
  }
  const auto own = std::int64_t(xy.size() / 2);
  xy.insert(xy.end(), table.XY.begin(), table.XY.end());
  std::vector<std::array<std::int64_t, 2>> constraints = table.Edges;
  for (auto& edge : constraints)
  {
    edge = { edge[0] + own, edge[1] + own };
  }
  ConstraintChains chains = findConstraintChains(xy, triangles, constraints, isCut);
  for (FixedEdge& edge : chains.Edges)
  {
    const auto [low, high] = std::minmax({ ids[std::size_t(edge[0])], ids[std::size_t(edge[1])] });
    edge = { low, high };
  }
  std::sort(chains.Edges.begin(), chains.Edges.end());
  return chains;
}

/// Does the same as checkDelaunay() for a partitioned mesh and points that are read block by block.
/// One piece at a time and the triangles near constraints are in memory. Throws IOError if a file
/// cannot be read, or if the mesh was made from other points.
CheckReport checkPartitioned(const CheckArguments& arguments)
{
  const PartitionedMesh mesh = openPartitionedMesh(arguments.Mesh);
  verifyPvtu(mesh);
  CheckOptions options = arguments.Options;
  ConstraintChains chains;
  if (!arguments.Constraints.empty())
  {
    ConstraintTable table = readConstraintFile(arguments.Constraints);
    takePositions(arguments, table);
    options.IsCut =
      options.IsCut || table.PolygonBegin < table.Edges.size() || !table.Holes.empty();
    chains = findChains(mesh, table, options.IsCut);
    options.Constraints = std::move(chains.Edges);
  }
  const InputSum input = sumInput(arguments.Points, arguments.Columns);
  PieceChecker checker(
    options, arguments.Constraints.empty() ? std::numeric_limits<std::int64_t>::max() : input.All);
  {
    ProgressBar bar("Checking");
    for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
    {
      PieceFile(mesh, number).verifyAll();
      checker.add(readChecked(mesh, number));
      bar.update(double(number + 1) / double(mesh.Pieces.size()));
    }
  }
  CheckReport report = checker.finish();
  report.LostConstraints = chains.Lost;
  if (input.Points != checker.givenPoints() || input.Sum != checker.pointSum())
  {
    refuseOtherPoints(arguments.Mesh, std::size_t(checker.givenPoints()), std::size_t(input.Points),
      arguments.Points);
  }
  return report;
}

constexpr const char* meshFormats =
  "The triangles: .npy (m x 3 integers), .14, .grd, a VTK file or a partitioned mesh; or "
  "tetrahedra: .npy (m x 4 integers), .vtu or a partitioned mesh";

constexpr const char* footer =
  R"(The check is exact and computes no triangulation of its own. It requires: every edge is in
at most two triangles, all triangles are counter-clockwise, every interior edge is locally
Delaunay, the boundary is one convex chain, the number of triangles follows Euler's formula,
and every distinct point is a vertex. If the mesh has the cell array NeighborIds, the two
triangles of every edge must store each other. A partitioned mesh is read piece by piece
and may be larger than memory. Exit codes: 0: no fault; 1: faults, or a file that cannot be
read; 2: wrong usage.

With --constraints, the constraints' edges need not be locally Delaunay, and the mesh may
have more points after the given ones. With --cut, or if the constraints have polygons or
holes, each boundary edge must be an edge of a constraint or of the convex hull, and
constraints may lie outside of the mesh. Whether the right triangles were removed is not
checked.

Tetrahedra are checked in the same way, in memory.

Examples:
  tipp check points.npy triangles.npy
  tipp check survey.csv --x easting --y northing mesh.vtp --tie-rule
  tipp check fort.14 fort.14 --boundary-free
  tipp check points.npy mesh.tipp
  tipp check survey.csv survey.vtp --constraints breaklines.vtp --tie-rule
  tipp check particles.npy tetrahedra.vtu --tie-rule
)";

// Throws IOError if the mesh stores points other than these.
void requireSamePoints(
  const CheckArguments& arguments, const std::vector<double>& xy, const std::vector<double>& own)
{
  if (!own.empty() && !std::equal(xy.begin(), xy.end(), own.begin(), own.end(), isSameNumber))
  {
    refuseOtherPoints(arguments.Mesh, own.size() / 2, xy.size() / 2, arguments.Points);
  }
}

/// Returns the constraints as indices of the mesh's points: the first one with equal coordinates,
/// or -1.
std::vector<std::array<std::int64_t, 2>> constraintsAmong(
  const std::vector<double>& xy, const ConstraintTable& table)
{
  if (table.XY.empty())
  {
    return table.Edges;
  }
  std::map<std::pair<double, double>, std::int64_t> positions;
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    positions.emplace(std::make_pair(xy[2 * i], xy[2 * i + 1]), std::int64_t(i));
  }
  std::vector<std::array<std::int64_t, 2>> constraints;
  for (const auto& edge : table.Edges)
  {
    std::array<std::int64_t, 2> ids;
    for (std::size_t end = 0; end < 2; ++end)
    {
      const auto own = 2 * std::size_t(edge[end]);
      const auto at = positions.find({ table.XY[own], table.XY[own + 1] });
      ids[end] = at == positions.end() ? -1 : at->second;
    }
    constraints.push_back(ids);
  }
  return constraints;
}

/// Checks a mesh with constraints, whose first points are the input points.
CheckReport checkConstrained(
  const CheckArguments& arguments, const PointTable& points, const TriangleMesh& mesh)
{
  const std::vector<double>& xy = mesh.XY.empty() ? points.XY : mesh.XY;
  if (xy.size() < points.XY.size() ||
    !std::equal(points.XY.begin(), points.XY.end(), xy.begin(), isSameNumber))
  {
    throw IOError(arguments.Mesh,
      fmt::format("its first {} points are not those of {}; check it against the points that it "
                  "was made from.",
        points.size(), arguments.Points));
  }
  const ConstraintTable table = readConstraintFile(arguments.Constraints);
  std::vector<std::array<std::int64_t, 2>> constraints = constraintsAmong(xy, table);
  const std::int64_t count = std::int64_t(xy.size() / 2);
  const auto lost = std::remove_if(constraints.begin(), constraints.end(),
    [count](const auto& ids)
    { return std::min(ids[0], ids[1]) < 0 || std::max(ids[0], ids[1]) >= count; });
  const std::int64_t missing = constraints.end() - lost;
  constraints.erase(lost, constraints.end());
  CheckOptions options = arguments.Options;
  options.IsCut = options.IsCut || table.PolygonBegin < table.Edges.size() || !table.Holes.empty();
  ConstraintChains chains = findConstraintChains(xy, mesh.Triangles, constraints, options.IsCut);
  options.Constraints = std::move(chains.Edges);
  CheckReport report = checkDelaunay(xy, mesh.Triangles, options, mesh.Neighbors);
  report.LostConstraints = chains.Lost + missing;
  return report;
}

CheckReport check(const CheckArguments& arguments)
{
  if (isStoredInPieces(arguments.Mesh))
  {
    return checkPartitioned(arguments);
  }
  const PointTable points = readPoints(arguments.Points, arguments.Columns);
  TriangleMesh mesh = readMesh(arguments.Mesh);
  if (!arguments.Constraints.empty())
  {
    return checkConstrained(arguments, points, mesh);
  }
  requireSamePoints(arguments, points.XY, mesh.XY);
  mesh.XY = {};
  return checkDelaunay(points.XY, mesh.Triangles, arguments.Options, mesh.Neighbors);
}

int runCheck(const CheckArguments& arguments)
{
  if (isOfTetrahedra(arguments.Mesh))
  {
    return runCheckTetrahedra(
      arguments.Points, arguments.Mesh, arguments.Columns, arguments.Options.TieRule);
  }
  const CheckReport report = check(arguments);
  fmt::print("{} points ({} distinct), {} triangles, {} boundary edges, {} co-circular ties: ",
    report.Points, report.DistinctPoints, report.Triangles, report.BoundaryEdges, report.Ties);
  return printFaults(report);
}

} // namespace

void addCheckCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* const command = app.add_subcommand(
    "check", "Checks that triangles are the Delaunay triangulation of points, exactly");
  command->add_option("points", arguments->Points, "The points, in any format of 'tipp delaunay'")
    ->required();
  command->add_option("mesh", arguments->Mesh, meshFormats)->required();
  addPointOptions(*command, arguments->Columns);
  command->add_flag("--tie-rule", arguments->Options.TieRule,
    "Also check that ties between co-circular points are broken by the points' lexicographic "
    "order, which makes the triangulation unique");
  command->add_flag("--boundary-free", arguments->Options.BoundaryFree,
    "The mesh need not fill the convex hull: do not check its boundary and Euler's formula");
  command->add_option("--constraints", arguments->Constraints,
    "The file of constraints that 'tipp delaunay' used; the mesh may have more points after the "
    "given ones");
  command->add_flag("--cut", arguments->Options.IsCut,
    "With --constraints: the mesh lacks triangles outside of polygons or in holes");
  command->footer(footer);
  command->callback(
    [arguments, &exitCode]() { exitCode = isIdleRank() ? Success : runCheck(*arguments); });
}

} // namespace tipp
