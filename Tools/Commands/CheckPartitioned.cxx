// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/CheckRuns.h"

#include "Arrays/SortUnique.h"
#include "Check/ConstraintChains.h"
#include "Console/ProgressBar.h"
#include "Partitioned/NeighborIds.h"
#include "Partitioned/PieceFile.h"
#include "Points/PointStream.h"
#include "Predicates/Points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

namespace tipp
{

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
    const auto at = [&piece](std::int64_t point)
    {
      const auto i = 2 * std::size_t(point);
      return check::Position{ piece.XY.at(i), piece.XY.at(i + 1) };
    };
    std::unordered_map<std::int64_t, std::int64_t> known;
    for (std::size_t t = 0; t < 3 * std::size_t(piece.OwnTriangles); t += 3)
    {
      const std::int64_t* const corners = &piece.Triangles[t];
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

} // namespace

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
    options.IsCut = arguments.isCutBy(table);
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
    refuseOtherPoints(arguments, std::size_t(checker.givenPoints()), std::size_t(input.Points));
  }
  return report;
}

} // namespace tipp
