// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/ReadPiece.h"

#include "Partitioned/BorrowedCells.h"
#include "Partitioned/PieceFile.h"

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
Buffer<char> readOwn(
  const PieceFile& file, std::size_t array, std::int64_t stored, std::int64_t tuples)
{
  const PieceArray& description = file.arrays()[array];
  Buffer<char> buffer(std::size_t(tuples) * description.tupleBytes());
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
      file.read(a, 0, end, nullptr);
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
  Buffer<char> wide(std::size_t(piece.Cells) * std::size_t(piece.CellSize) * 8);
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

/// Reads the tuples of a cell array with the given ascending indices. The result has room for
/// `tuples` tuples.
Buffer<char> readChosen(const PieceFile& file, std::size_t array, std::int64_t stored,
  const std::vector<std::int64_t>& chosen, std::int64_t tuples)
{
  const std::size_t bytes = file.arrays()[array].tupleBytes();
  Buffer<char> buffer(std::size_t(tuples) * bytes);
  std::size_t next = 0;
  file.visit(array, 0, endOfParts(file, false, stored),
    [&](std::int64_t first, std::int64_t count, const char* block)
    {
      for (; next < chosen.size() && chosen[next] < first + count; ++next)
      {
        std::memcpy(
          buffer.data() + next * bytes, block + std::size_t(chosen[next] - first) * bytes, bytes);
      }
      return true;
    });
  return buffer;
}

/// Reads the connectivity of the cells that the options choose, and their indices in the file.
template <typename InFile, typename InPiece>
std::vector<std::int64_t> chooseCells(const PieceFile& file, const PieceOptions& options,
  std::int64_t stored, std::int64_t borrowed, Piece& piece)
{
  const auto corners = std::size_t(piece.CellSize);
  std::vector<std::int64_t> chosen;
  std::vector<InPiece> ids;
  file.visit(file.find(PieceRole::Connectivity), 0, endOfParts(file, false, stored),
    [&](std::int64_t first, std::int64_t count, const char* block)
    {
      const auto* const cells = reinterpret_cast<const InFile*>(block);
      if (!areBelow(cells, std::size_t(count) * corners, piece.Points))
      {
        file.fail("has cells with points that it does not have");
      }
      std::size_t next = chosen.size();
      piece.IsStopped = !options.Cells(piece, first, count, block, sizeof(InFile) == 8, chosen);
      for (; next < chosen.size(); ++next)
      {
        const InFile* const cell = cells + std::size_t(chosen[next] - first) * corners;
        ids.insert(ids.end(), cell, cell + corners);
      }
      return !piece.IsStopped;
    });
  piece.OwnedCells = std::int64_t(chosen.size());
  piece.Cells = piece.OwnedCells + borrowed;
  piece.Connectivity = Buffer<char>(std::size_t(piece.Cells) * corners * sizeof(InPiece));
  std::copy(ids.begin(), ids.end(), piece.Connectivity.as<InPiece>());
  return chosen;
}

/// Like readCells(), for the cells that the options choose. Returns their indices in the file.
std::vector<std::int64_t> readChosenCells(const PartitionedMesh& mesh, const PieceFile& file,
  const PieceOptions& options, std::int64_t stored, std::int64_t borrowed, Piece& piece)
{
  const bool wideInFile = hasWideIds(mesh, file.summary());
  piece.WideIds = wideInFile || piece.Points > std::numeric_limits<std::int32_t>::max();
  const auto choose = wideInFile ? chooseCells<std::int64_t, std::int64_t>
    : piece.WideIds              ? chooseCells<std::int32_t, std::int64_t>
                                 : chooseCells<std::int32_t, std::int32_t>;
  std::vector<std::int64_t> chosen = choose(file, options, stored, borrowed, piece);
  if (!piece.IsStopped)
  {
    piece.CellIds = readChosen(file, file.find(PieceRole::CellIds), stored, chosen, piece.Cells);
    file.requireIds(piece.CellIds.as<std::int64_t>(), chosen.size(), mesh.Cells);
  }
  return chosen;
}

/// Reads the requested attributes. `chosen` has the file indices of the cells; null: all cells.
void readAttributes(const PartitionedMesh& mesh, const PieceOptions& options, const PieceFile& file,
  std::int64_t storedPoints, std::int64_t storedCells, const std::vector<std::int64_t>* chosen,
  Piece& piece)
{
  for (std::size_t i = 0; i < mesh.Arrays.size(); ++i)
  {
    if (options.wants(mesh, i))
    {
      const bool ofPoints = mesh.Arrays[i].OfPoints;
      const std::size_t array = file.findAttribute(i);
      Buffer<char> values = ofPoints ? readOwn(file, array, storedPoints, piece.Points)
        : chosen                     ? readChosen(file, array, storedCells, *chosen, piece.Cells)
                                     : readOwn(file, array, storedCells, piece.Cells);
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

  std::optional<BorrowedCells> borrowed;
  if (options.Borrowed && !mesh.Duplicated)
  {
    Buffer<char> ids = readOwn(file, file.find(PieceRole::PointIds), storedPoints, storedPoints);
    file.requireIds(ids.as<std::int64_t>(), std::size_t(storedPoints), mesh.Points);
    borrowed.emplace(mesh, file, ids.as<std::int64_t>(), piece.Counters);
    piece.Points = storedPoints + borrowed->pointCount();
    piece.Cells = storedCells + borrowed->cellCount();
    piece.PointIds = options.Cells ? Buffer<char>() : Buffer<char>(std::size_t(piece.Points) * 8);
    options.Cells ? void() : void(std::copy_n(ids.data(), ids.size(), piece.PointIds.data()));
  }
  else
  {
    piece.Points = storedPoints;
    piece.Cells = storedCells;
    if (!options.Cells)
    {
      piece.PointIds = readOwn(file, file.find(PieceRole::PointIds), storedPoints, storedPoints);
      file.requireIds(piece.PointIds.as<std::int64_t>(), std::size_t(storedPoints), mesh.Points);
    }
  }
  piece.Coordinates = readOwn(file, file.find(PieceRole::Points), storedPoints, piece.Points);
  borrowed ? borrowed->fillCoordinates(piece) : void();
  std::vector<std::int64_t> chosen;
  if (options.Cells)
  {
    chosen = readChosenCells(
      mesh, file, options, storedCells, borrowed ? borrowed->cellCount() : 0, piece);
  }
  else
  {
    piece.PointGhosts =
      readOwn(file, file.find(PieceRole::PointGhosts), storedPoints, piece.Points);
    readCells(mesh, file, storedCells, piece);
  }
  if (piece.IsStopped)
  {
    return piece;
  }
  readAttributes(
    mesh, options, file, storedPoints, storedCells, options.Cells ? &chosen : nullptr, piece);
  borrowed ? borrowed->fill(options, piece) : void();
  return piece;
}

} // namespace tipp
