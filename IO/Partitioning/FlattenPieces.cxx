// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/FlattenPieces.h"

#include "Files/IOError.h"
#include "Parallel/Poll.h"
#include "Partitioned/ReadPiece.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Visits a piece's own points, or cells: calls visit(index in the piece, global id).
template <typename Visit>
void forOwned(const PartitionedMesh& mesh, const Piece& piece, bool ofPoints, const Visit& visit)
{
  const std::int64_t count = ofPoints ? piece.OwnedPoints : piece.OwnedCells;
  const std::int64_t most = ofPoints ? mesh.Points : mesh.Cells;
  const auto* const ids = (ofPoints ? piece.PointIds : piece.CellIds).as<std::int64_t>();
  const auto* const ghosts = piece.PointGhosts.as<std::uint8_t>();
  for (std::int64_t i = 0; i < count; ++i)
  {
    if (ids[i] < 0 || ids[i] >= most)
    {
      throw IOError(mesh.Path,
        std::string("has a ") + (ofPoints ? "point" : "cell") + " of the number " +
          std::to_string(ids[i]) + ", and there are " + std::to_string(most) +
          "; partition the mesh again.");
    }
    if (!ofPoints || ghosts[i] == 0)
    {
      visit(i, ids[i]);
    }
  }
}

/// Reads a point or cell array of all pieces, step by step.
class ArrayReader
{
public:
  ArrayReader(const PartitionedMesh& mesh, std::size_t array)
    : Mesh(mesh)
    , Array(array)
  {
  }

  const void* read(std::int64_t step)
  {
    const StoredArray& described = this->Mesh.Arrays[this->Array];
    const std::size_t tuple = scalarSize(described.Type) * std::size_t(described.Components);
    PieceOptions options;
    options.Borrowed = false;
    options.Step = int(step);
    // All steps of an array have its name; the one of this step is read.
    for (const StoredArray& array : this->Mesh.Arrays)
    {
      options.Wanted.push_back(
        array.Name == described.Name && array.OfPoints == described.OfPoints);
    }
    this->Values.assign(
      std::size_t(described.OfPoints ? this->Mesh.Points : this->Mesh.Cells) * tuple, 0);
    for (std::size_t number = 0; number < this->Mesh.Pieces.size(); ++number)
    {
      poll();
      const Piece piece = readPiece(this->Mesh, number, options);
      for (const Piece::Attribute& attribute : piece.Attributes)
      {
        const auto* const from = attribute.Values.as<char>();
        forOwned(this->Mesh, piece, described.OfPoints,
          [&](std::int64_t i, std::int64_t id)
          {
            std::memcpy(
              this->Values.data() + std::size_t(id) * tuple, from + std::size_t(i) * tuple, tuple);
          });
      }
    }
    return this->Values.data();
  }

private:
  const PartitionedMesh& Mesh;
  const std::size_t Array;
  std::vector<char> Values;
};

/// Reads the points and cells of all pieces.
void readMesh(const PartitionedMesh& mesh, FlatContent& content)
{
  const std::size_t tuple = 3 * scalarSize(mesh.PointType);
  const auto points = std::make_shared<std::vector<char>>(std::size_t(mesh.Points) * tuple);
  const auto corners = std::size_t(mesh.CellSize);
  content.Cells.assign(std::size_t(mesh.Cells) * corners, -1);
  std::int64_t found = 0;
  PieceOptions options;
  options.Borrowed = false;
  options.Wanted.assign(mesh.Arrays.size(), false);
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    poll();
    const Piece piece = readPiece(mesh, number, options);
    const auto* const ids = piece.PointIds.as<std::int64_t>();
    forOwned(mesh, piece, true,
      [&](std::int64_t i, std::int64_t id)
      {
        std::memcpy(points->data() + std::size_t(id) * tuple,
          piece.Coordinates.as<char>() + std::size_t(i) * tuple, tuple);
        ++found;
      });
    forOwned(mesh, piece, false,
      [&](std::int64_t i, std::int64_t id)
      {
        for (std::size_t corner = 0; corner < corners; ++corner)
        {
          content.Cells[std::size_t(id) * corners + corner] =
            ids[std::size_t(piece.corner(i, int(corner)))];
        }
      });
  }
  const bool isWhole = std::all_of(content.Cells.begin(), content.Cells.end(),
    [&mesh](std::int64_t id) { return id >= 0 && id < mesh.Points; });
  if (found != mesh.Points || !isWhole)
  {
    throw IOError(mesh.Path, "lacks points or cells in its pieces; partition the mesh again.");
  }
  content.Points = { "points", mesh.PointType, 3, mesh.Points, 0, points->data(), points };
}

} // namespace

FlatContent flattenPieces(const PartitionedMesh& mesh)
{
  FlatContent content;
  content.CellSize = mesh.CellSize;
  readMesh(mesh, content);
  for (std::size_t i = 0; i < mesh.Arrays.size(); ++i)
  {
    const StoredArray& array = mesh.Arrays[i];
    if (array.Step > 0)
    {
      continue; // is read with the first step
    }
    FlatArray flat;
    flat.Name = array.Name;
    flat.Type = array.Type;
    flat.Components = array.Components;
    flat.Tuples = array.OfPoints ? mesh.Points : mesh.Cells;
    flat.Steps = array.Step < 0 ? 0 : std::int64_t(mesh.Times.size());
    const auto reader = std::make_shared<ArrayReader>(mesh, i);
    flat.StepValues = [reader](std::int64_t step) { return reader->read(step); };
    (array.OfPoints ? content.PointData : content.CellData).push_back(std::move(flat));
  }
  content.Times = mesh.Times;
  content.Description = mesh.Description;
  return content;
}

} // namespace tipp
