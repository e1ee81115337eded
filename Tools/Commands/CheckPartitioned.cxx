// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/CheckPartitioned.h"

#include "Check/PieceChecker.h"
#include "Console/ProgressBar.h"
#include "Files/IOError.h"
#include "Partitioned/NeighborIds.h"
#include "Partitioned/ReadPiece.h"
#include "Points/PointStream.h"
#include "Predicates/Point2.h"

#include <fmt/format.h>

namespace tipp
{
namespace
{

CheckedPiece readChecked(const PartitionedMesh& mesh, std::size_t number)
{
  PieceOptions options;
  options.Wanted.assign(mesh.Arrays.size(), false);
  const std::int64_t neighborIds = findNeighborIds(mesh);
  if (neighborIds >= 0)
  {
    options.Wanted[std::size_t(neighborIds)] = true;
  }
  Piece piece = readPiece(mesh, number, options);
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
  if (neighborIds >= 0)
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
  std::int64_t Points = 0; ///< with finite coordinates
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

} // namespace

CheckReport checkPartitioned(const std::string& points, const PointOptions& columns,
  const std::string& path, const CheckOptions& options)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  if (mesh.CellSize != 3)
  {
    throw IOError(path, "holds tetrahedra; the check is of triangles.");
  }
  verifyPvtu(mesh);
  PieceChecker checker(options);
  {
    ProgressBar bar("Checking");
    for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
    {
      ReadCounters counters;
      PieceFile(mesh, number, counters).verifyAll();
      checker.add(readChecked(mesh, number));
      bar.update(double(number + 1) / double(mesh.Pieces.size()));
    }
  }
  CheckReport report = checker.finish();
  const InputSum input = sumInput(points, columns);
  if (input.Points != report.Points || input.Sum != checker.pointSum())
  {
    throw IOError(path,
      fmt::format("its {} points are not the {} points of {}; check it against the points that it "
                  "was made from.",
        report.Points, input.Points, points));
  }
  return report;
}

} // namespace tipp
