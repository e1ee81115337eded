// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/CheckRuns.h"

#include "Check/TetrahedraChecker.h"
#include "Meshes/MeshFiles.h"
#include "Partitioned/PieceFile.h"
#include "Points/PointStream.h"

#include <algorithm>
#include <cmath>

namespace tipp
{

namespace
{

/// Reads the tetrahedra of a partitioned mesh. Throws IOError unless its points are the finite ones
/// among `xyz`.
StoredTetrahedra readPieces(const CheckArguments& arguments, const std::vector<double>& xyz)
{
  const PartitionedMesh mesh = openPartitionedMesh(arguments.Mesh);
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
    refuseOtherPoints(arguments, found, finite);
  }
  return stored;
}

} // namespace

int checkTetrahedra(const CheckArguments& arguments)
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
  const TetrahedraReport report =
    checkTetrahedra(xyz, stored.Ids, arguments.Options.TieRule, stored.Neighbors);
  fmt::print("{} points ({} distinct), {} tetrahedra, {} hull facets, {} co-spherical ties: ",
    report.Points, report.DistinctPoints, report.Tetrahedra, report.HullFacets, report.Ties);
  return printFaults(report);
}

} // namespace tipp
