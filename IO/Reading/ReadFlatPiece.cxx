// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/ReadFlatPiece.h"

#include "Files/InputFile.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tipp
{
namespace
{

Buffer<char> bytesOf(const RawArray& array)
{
  Buffer<char> bytes(std::size_t(array.bytes()));
  InputFile(array.Path).read(array.Offset, bytes.data(), bytes.size());
  return bytes;
}

} // namespace

Piece readFlatPiece(const FlatMesh& mesh, int threads)
{
  std::vector<std::int64_t> ids;
  CellReader(mesh, threads).read(0, mesh.Cells.Tuples, ids);
  Piece piece;
  piece.CellSize = mesh.CellSize;
  piece.PointType = mesh.Points.Type;
  piece.Points = piece.OwnedPoints = mesh.Points.Tuples;
  piece.Cells = piece.OwnedCells = mesh.Cells.Tuples;
  piece.Coordinates = bytesOf(mesh.Points);
  piece.WideIds = true;
  piece.Connectivity = Buffer<char>(ids.size() * sizeof(std::int64_t));
  std::copy(ids.begin(), ids.end(), piece.Connectivity.as<std::int64_t>());
  for (const bool ofPoints : { true, false })
  {
    for (const RawArray& array : ofPoints ? mesh.PointData : mesh.CellData)
    {
      Piece::Attribute& read = piece.Attributes.emplace_back();
      read.Description = { array.Name, ofPoints, array.Type, array.Components, -1 };
      read.Values = bytesOf(array);
    }
  }
  return piece;
}

} // namespace tipp
