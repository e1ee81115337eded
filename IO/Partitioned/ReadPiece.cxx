// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/ReadPiece.h"

#include "Partitioned/BorrowedByReference.h"
#include "Partitioned/IdRange.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

namespace tipp
{
namespace
{

/// The end of the parts that hold the first `stored` tuples of an array. The last parts may be
/// empty.
std::size_t endOfParts(const PieceFile& file, bool ofPoints, std::int64_t stored)
{
  const std::vector<std::int64_t>& starts = file.partStarts(ofPoints);
  std::size_t end = starts.size() - 1;
  while (end > 0 && starts[end] > stored)
  {
    --end;
  }
  return end;
}

/// Reads one array's tuples in the piece's own file; the rest of the buffer stays uninitialised.
RawBuffer readOwn(
  const PieceFile& file, std::size_t array, std::int64_t stored, std::int64_t tuples)
{
  const PieceArray& description = file.arrays()[array];
  RawBuffer buffer(std::size_t(tuples) * description.tupleBytes());
  file.read(array, 0, endOfParts(file, description.ofPoints(), stored), buffer.data());
  return buffer;
}

/// Verifies the arrays that only VTK's readers need. The result does not depend on them, but a
/// damaged file must be refused whichever array is affected.
void verifyUnused(const PieceFile& file, std::int64_t stored)
{
  const std::size_t end = endOfParts(file, false, stored);
  for (std::size_t a = 0; a < file.arrays().size(); ++a)
  {
    const PieceRole role = file.arrays()[a].Role;
    if (role == PieceRole::Offsets || role == PieceRole::Types || role == PieceRole::CellGhosts)
    {
      file.verify(a, 0, end);
    }
  }
}

void requireLocalIds(const PieceFile& file, const Piece& piece, std::int64_t cells)
{
  const std::size_t count = std::size_t(cells) * std::size_t(piece.CellSize);
  const bool good = piece.WideIds
    ? areBelow(piece.Connectivity.as<std::int64_t>(), count, piece.Points)
    : areBelow(piece.Connectivity.as<std::int32_t>(), count, piece.Points);
  if (!good)
  {
    file.fail("has cells with points that it does not have");
  }
}

/// Converts ids from 32 to 64 bits if borrowed cells have made the piece too large for 32.
void widen(Piece& piece, std::int64_t cells)
{
  const std::size_t count = std::size_t(cells) * std::size_t(piece.CellSize);
  RawBuffer wide(std::size_t(piece.Cells) * std::size_t(piece.CellSize) * 8);
  std::copy_n(piece.Connectivity.as<std::int32_t>(), count, wide.as<std::int64_t>());
  piece.Connectivity = std::move(wide);
}

void readCells(
  const PartitionedMesh& mesh, const PieceFile& file, std::int64_t stored, Piece& piece)
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  const bool wideInFile = hasWideIds(mesh, file.summary());
  piece.Connectivity = readOwn(file, file.find(PieceRole::Connectivity), stored, piece.Cells);
  piece.WideIds = wideInFile || piece.Points > most || piece.Cells > most / piece.CellSize;
  if (piece.WideIds && !wideInFile)
  {
    widen(piece, stored);
  }
  requireLocalIds(file, piece, stored);
  piece.CellIds = readOwn(file, file.find(PieceRole::CellIds), stored, piece.Cells);
  file.requireIds(piece.CellIds.as<std::int64_t>(), std::size_t(stored), mesh.Cells);
  verifyUnused(file, stored);
}

void readAttributes(const PartitionedMesh& mesh, const PieceOptions& options, const PieceFile& file,
  std::int64_t storedPoints, std::int64_t storedCells, Piece& piece)
{
  for (std::size_t i = 0; i < mesh.Arrays.size(); ++i)
  {
    if (options.wants(mesh, i))
    {
      const bool ofPoints = mesh.Arrays[i].OfPoints;
      RawBuffer values = readOwn(file, file.findAttribute(i), ofPoints ? storedPoints : storedCells,
        ofPoints ? piece.Points : piece.Cells);
      piece.Attributes.push_back({ mesh.Arrays[i], std::move(values) });
    }
  }
}

} // namespace

bool PieceOptions::wants(const PartitionedMesh& mesh, std::size_t attribute) const
{
  const int step = mesh.Arrays[attribute].Step;
  return (this->Wanted.empty() || this->Wanted[attribute]) && (step < 0 || step == this->Step);
}

Piece readPiece(const PartitionedMesh& mesh, std::size_t number, const PieceOptions& options)
{
  Piece piece;
  const PieceFile file(mesh, number, piece.Counters);
  const PieceSummary& summary = file.summary();
  const bool whole = options.Borrowed && mesh.Duplicated;
  const std::int64_t storedPoints = summary.Points + (whole ? summary.GhostPoints : 0);
  const std::int64_t storedCells = summary.Cells + (whole ? summary.BorrowedCells : 0);
  piece.CellSize = mesh.CellSize;
  piece.PointType = mesh.PointType;
  piece.OwnedPoints = summary.Points;
  piece.OwnedCells = summary.Cells;

  std::optional<BorrowedByReference> borrowed;
  if (options.Borrowed && !mesh.Duplicated)
  {
    RawBuffer ids = readOwn(file, file.find(PieceRole::PointIds), storedPoints, storedPoints);
    file.requireIds(ids.as<std::int64_t>(), std::size_t(storedPoints), mesh.Points);
    borrowed.emplace(mesh, file, ids.as<std::int64_t>(), piece.Counters);
    piece.Points = storedPoints + borrowed->pointCount();
    piece.Cells = storedCells + borrowed->cellCount();
    piece.PointIds = RawBuffer(std::size_t(piece.Points) * 8);
    std::memcpy(piece.PointIds.data(), ids.data(), ids.size());
  }
  else
  {
    piece.Points = storedPoints;
    piece.Cells = storedCells;
    piece.PointIds = readOwn(file, file.find(PieceRole::PointIds), storedPoints, storedPoints);
    file.requireIds(piece.PointIds.as<std::int64_t>(), std::size_t(storedPoints), mesh.Points);
  }
  piece.Coordinates = readOwn(file, file.find(PieceRole::Points), storedPoints, piece.Points);
  piece.PointGhosts = readOwn(file, file.find(PieceRole::PointGhosts), storedPoints, piece.Points);
  readCells(mesh, file, storedCells, piece);
  readAttributes(mesh, options, file, storedPoints, storedCells, piece);
  if (borrowed)
  {
    borrowed->fill(piece);
  }
  return piece;
}

} // namespace tipp
