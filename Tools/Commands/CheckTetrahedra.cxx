// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/CheckTetrahedra.h"

#include "Check/TetrahedraChecker.h"
#include "Files/IOError.h"
#include "Meshes/MeshFiles.h"
#include "Partitioned/NeighborIds.h"
#include "Partitioned/PieceFile.h"
#include "Points/PointStream.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace tipp
{

bool isStoredInPieces(const std::string& mesh)
{
  std::error_code ignored;
  return isPartitionedMesh(mesh) || std::filesystem::is_directory(mesh, ignored);
}

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

void refuseOtherPoints(
  const std::string& mesh, std::size_t count, std::size_t points, const std::string& input)
{
  throw IOError(mesh,
    fmt::format("its {} points are not the {} points of {}; check it against the points that it "
                "was made from.",
      count, points, input));
}

namespace
{

/// Reads the tetrahedra of a partitioned mesh. Throws IOError unless its points are the finite ones
/// among `xyz`.
StoredTetrahedra readPieces(
  const std::string& path, const std::vector<double>& xyz, const std::string& input)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  verifyPvtu(mesh);
  StoredTetrahedra stored;
  const PieceOptions options = withNeighborsOnly(mesh);
  std::size_t found = 0;
  bool areSame = true;
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    PieceFile(mesh, number).verifyAll();
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
    refuseOtherPoints(path, found, finite, input);
  }
  return stored;
}

} // namespace

bool isOfTetrahedra(const std::string& mesh)
{
  return isStoredInPieces(mesh) ? openPartitionedMesh(mesh).CellSize == 4 : holdsTetrahedra(mesh);
}

int runCheckTetrahedra(
  const std::string& points, const std::string& mesh, PointOptions columns, bool tieRule)
{
  columns.InSpace = true;
  const PointTable table = readAllPoints(*openPointStream({ points }, columns));
  const std::vector<double>& z = table.Columns[requireElevation(table, points)].Values;
  std::vector<double> xyz;
  xyz.reserve(3 * table.size());
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    xyz.insert(xyz.end(), { table.XY[2 * i], table.XY[2 * i + 1], z[i] });
  }
  const StoredTetrahedra stored =
    isStoredInPieces(mesh) ? readPieces(mesh, xyz, points) : readTetrahedra(mesh);
  if (!stored.XYZ.empty() &&
    !std::equal(xyz.begin(), xyz.end(), stored.XYZ.begin(), stored.XYZ.end(), isSameNumber))
  {
    refuseOtherPoints(mesh, stored.XYZ.size() / 3, table.size(), points);
  }
  const TetrahedraReport report = checkTetrahedra(xyz, stored.Ids, tieRule, stored.Neighbors);
  fmt::print("{} points ({} distinct), {} tetrahedra, {} hull facets, {} co-spherical ties: ",
    report.Points, report.DistinctPoints, report.Tetrahedra, report.HullFacets, report.Ties);
  return printFaults(report);
}

} // namespace tipp
