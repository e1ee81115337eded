// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCoreTesting.h"

#include "Npy/NpyFile.h"
#include "Partitioned/PartitionedMesh.h"

namespace tipp
{
namespace test
{
namespace
{

template <typename Visit>
void visitOwned(const std::string& path, const Visit& visit)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    PieceOptions options;
    options.Borrowed = false;
    const Piece piece = readPiece(mesh, number, options);
    const auto* ids = piece.PointIds.as<std::int64_t>();
    const auto* corners = piece.Connectivity.as<std::int32_t>();
    for (std::int64_t cell = 0; cell < piece.Cells; ++cell, corners += 3)
    {
      visit(
        piece.CellIds.as<std::int64_t>()[cell], ids[corners[0]], ids[corners[1]], ids[corners[2]]);
    }
  }
}

} // namespace

OutOfCoreStatistics triangulateFile(
  const TemporaryFolder& folder, const Coordinates& xy, const OutOfCoreOptions& options)
{
  writePoints(folder.path("points.npy"), xy);
  const auto points = openPointStream({ folder.path("points.npy") });
  return triangulateOutOfCore(*points, folder.path("mesh.tipp"), options);
}

Triangles trianglesOfMesh(const std::string& path)
{
  Triangles triangles;
  visitOwned(path,
    [&](std::int64_t, std::int64_t a, std::int64_t b, std::int64_t c)
    { triangles.push_back(canonical(a, b, c)); });
  return sorted(std::move(triangles));
}

testing::AssertionResult meshMatches(
  const std::string& path, const Coordinates& xy, const Reference& expected)
{
  return sameTriangles(xy, trianglesOfMesh(path), expected.Mesh);
}

SourceMesh sourceOf(const std::string& path, const Coordinates& xy)
{
  SourceMesh source;
  source.Coordinates = xy;
  source.Cells.resize(3 * std::size_t(openPartitionedMesh(path).Cells), -1);
  visitOwned(path,
    [&](std::int64_t cell, std::int64_t a, std::int64_t b, std::int64_t c)
    {
      source.Cells.at(3 * std::size_t(cell)) = a;
      source.Cells[3 * std::size_t(cell) + 1] = b;
      source.Cells[3 * std::size_t(cell) + 2] = c;
    });
  return source;
}

} // namespace test
} // namespace tipp
