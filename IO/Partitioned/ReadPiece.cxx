// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/ReadPiece.h"

#include "Flat/FlatMesh.h"
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

class PieceReader
{
public:
  PieceReader(const PartitionedMesh& mesh, std::size_t number, const PieceOptions& options)
    : Mesh(mesh)
    , Options(options)
    , File(mesh, number)
  {
    const PieceSummary& summary = this->File.summary();
    const bool whole = options.Borrowed && mesh.Duplicated;
    this->StoredPoints = summary.Points + (whole ? summary.GhostPoints : 0);
    this->StoredCells = summary.Cells + (whole ? summary.BorrowedCells : 0);
    this->Result.CellSize = mesh.CellSize;
    this->Result.PointType = mesh.PointType;
    this->Result.OwnedPoints = summary.Points;
    this->Result.OwnedCells = summary.Cells;
    this->Result.Points = this->StoredPoints;
    this->Result.Cells = this->StoredCells;
  }

  Piece read()
  {
    const bool byReference = this->Options.Borrowed && !this->Mesh.Duplicated;
    Buffer<char> ids;
    if (byReference || !this->Options.Cells)
    {
      ids = this->readOwn(PieceRole::PointIds);
      this->File.requireIds(
        ids.as<std::int64_t>(), std::size_t(this->StoredPoints), this->Mesh.Points);
    }
    if (byReference)
    {
      this->Borrowed.emplace(this->Mesh, this->File, ids.as<std::int64_t>());
      this->Result.Points += this->Borrowed->pointCount();
      this->Result.Cells += this->Borrowed->cellCount();
      Buffer<char> all(this->Options.Cells ? 0 : std::size_t(this->Result.Points) * 8);
      std::copy_n(ids.data(), std::min(ids.size(), all.size()), all.data());
      ids = std::move(all);
    }
    this->Result.Coordinates = this->readOwn(PieceRole::Points);
    this->Borrowed ? this->Borrowed->fillCoordinates(this->Result) : void();
    if (this->Options.Cells)
    {
      this->readChosenCells();
    }
    else
    {
      this->Result.PointIds = std::move(ids);
      this->Result.PointGhosts = this->readOwn(PieceRole::PointGhosts);
      this->readCells();
    }
    if (!this->Result.IsStopped)
    {
      this->readAttributes();
      this->Borrowed ? this->Borrowed->fill(this->Options, this->Result) : void();
    }
    this->Result.BytesRead =
      this->File.bytesRead() + (this->Borrowed ? this->Borrowed->bytesRead() : 0);
    return std::move(this->Result);
  }

private:
  /// The end of the parts that hold the stored tuples. The last parts may be empty.
  std::size_t endOfParts(bool ofPoints) const
  {
    const std::vector<std::int64_t>& starts = this->File.partStarts(ofPoints);
    std::size_t end = starts.size() - 1;
    while (end > 0 && starts[end] > (ofPoints ? this->StoredPoints : this->StoredCells))
    {
      --end;
    }
    return end;
  }

  /// Reads one array's tuples in the piece's own file; the rest of the buffer stays uninitialised.
  Buffer<char> readOwn(std::size_t array) const
  {
    const PieceArray& description = this->File.arrays()[array];
    const bool ofPoints = description.ofPoints();
    Buffer<char> buffer(
      std::size_t(ofPoints ? this->Result.Points : this->Result.Cells) * description.tupleBytes());
    this->File.read(array, 0, this->endOfParts(ofPoints), buffer.data());
    return buffer;
  }
  Buffer<char> readOwn(PieceRole role) const { return this->readOwn(this->File.find(role)); }

  /// Throws IOError unless all local point ids are in the piece.
  template <typename Id>
  void requireLocalIds(const Id* ids, std::int64_t cells) const
  {
    if (!areBelow(ids, std::size_t(cells * this->Result.CellSize), this->Result.Points))
    {
      this->File.fail("has cells with points that it does not have");
    }
  }

  void readCells()
  {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    Piece& piece = this->Result;
    const bool wideInFile = hasWideIds(this->Mesh, this->File.summary());
    piece.Connectivity = this->readOwn(PieceRole::Connectivity);
    wideInFile ? this->requireLocalIds(piece.Connectivity.as<std::int64_t>(), this->StoredCells)
               : this->requireLocalIds(piece.Connectivity.as<std::int32_t>(), this->StoredCells);
    piece.WideIds = wideInFile || piece.Points > most || piece.Cells > most / piece.CellSize;
    if (piece.WideIds && !wideInFile) // borrowed cells have made it too large for 32 bits
    {
      Buffer<char> wide(std::size_t(piece.Cells * piece.CellSize) * 8);
      std::copy_n(piece.Connectivity.as<std::int32_t>(),
        std::size_t(this->StoredCells * piece.CellSize), wide.as<std::int64_t>());
      piece.Connectivity = std::move(wide);
    }
    piece.CellIds = this->readOwn(PieceRole::CellIds);
    this->File.requireIds(
      piece.CellIds.as<std::int64_t>(), std::size_t(this->StoredCells), this->Mesh.Cells);
    // Only VTK's readers need these arrays. The result does not depend on them, but a damaged file
    // must be refused whichever array is affected.
    for (const PieceRole role : { PieceRole::Offsets, PieceRole::Types, PieceRole::CellGhosts })
    {
      const std::size_t array = this->File.find(role);
      if (array < this->File.arrays().size())
      {
        this->File.read(array, 0, this->endOfParts(false), nullptr);
      }
    }
  }

  /// Reads the tuples of a cell array that belong to the chosen cells.
  Buffer<char> readChosen(std::size_t array) const
  {
    const std::size_t bytes = this->File.arrays()[array].tupleBytes();
    Buffer<char> buffer(std::size_t(this->Result.Cells) * bytes);
    std::size_t next = 0;
    this->File.visit(array, 0, this->endOfParts(false),
      [&](std::int64_t first, std::int64_t count, const char* block)
      {
        for (; next < this->Chosen.size() && this->Chosen[next] < first + count; ++next)
        {
          std::memcpy(buffer.data() + next * bytes,
            block + std::size_t(this->Chosen[next] - first) * bytes, bytes);
        }
        return true;
      });
    return buffer;
  }

  /// Reads the connectivity of the cells that the options choose.
  template <typename InFile, typename InPiece>
  void chooseCells()
  {
    Piece& piece = this->Result;
    const auto corners = std::size_t(piece.CellSize);
    std::vector<InPiece> ids;
    this->File.visit(this->File.find(PieceRole::Connectivity), 0, this->endOfParts(false),
      [&](std::int64_t first, std::int64_t count, const char* block)
      {
        const auto* const cells = reinterpret_cast<const InFile*>(block);
        this->requireLocalIds(cells, count);
        std::size_t next = this->Chosen.size();
        piece.IsStopped =
          !this->Options.Cells(piece, first, count, block, sizeof(InFile) == 8, this->Chosen);
        for (; next < this->Chosen.size(); ++next)
        {
          const InFile* const cell = cells + std::size_t(this->Chosen[next] - first) * corners;
          ids.insert(ids.end(), cell, cell + corners);
        }
        return !piece.IsStopped;
      });
    piece.OwnedCells = std::int64_t(this->Chosen.size());
    piece.Cells = piece.OwnedCells + (this->Borrowed ? this->Borrowed->cellCount() : 0);
    piece.Connectivity = Buffer<char>(std::size_t(piece.Cells) * corners * sizeof(InPiece));
    std::copy(ids.begin(), ids.end(), piece.Connectivity.as<InPiece>());
  }

  /// Like readCells(), for the cells that the options choose.
  void readChosenCells()
  {
    Piece& piece = this->Result;
    const bool wideInFile = hasWideIds(this->Mesh, this->File.summary());
    piece.WideIds = wideInFile || piece.Points > std::numeric_limits<std::int32_t>::max();
    wideInFile        ? this->chooseCells<std::int64_t, std::int64_t>()
      : piece.WideIds ? this->chooseCells<std::int32_t, std::int64_t>()
                      : this->chooseCells<std::int32_t, std::int32_t>();
    if (!piece.IsStopped)
    {
      piece.CellIds = this->readChosen(this->File.find(PieceRole::CellIds));
      this->File.requireIds(
        piece.CellIds.as<std::int64_t>(), this->Chosen.size(), this->Mesh.Cells);
    }
  }

  void readAttributes()
  {
    for (std::size_t i = 0; i < this->Mesh.Arrays.size(); ++i)
    {
      if (this->Options.wants(this->Mesh, i))
      {
        const std::size_t array = this->File.findAttribute(i);
        const bool isChosen = this->Options.Cells && !this->Mesh.Arrays[i].OfPoints;
        this->Result.Attributes.push_back(
          { this->Mesh.Arrays[i], isChosen ? this->readChosen(array) : this->readOwn(array) });
      }
    }
  }

  const PartitionedMesh& Mesh;
  const PieceOptions& Options;
  const PieceFile File;
  std::int64_t StoredPoints = 0; ///< that are in the file and needed
  std::int64_t StoredCells = 0;  ///< likewise
  std::optional<BorrowedCells> Borrowed;
  std::vector<std::int64_t> Chosen; ///< indices in the file of the chosen cells, ascending
  Piece Result;
};

} // namespace

bool PieceOptions::wants(const PartitionedMesh& mesh, std::size_t attribute) const
{
  const int step = mesh.Arrays[attribute].Step;
  return (this->Wanted.empty() || this->Wanted[attribute]) && (step < 0 || step == this->Step);
}

Piece readPiece(const PartitionedMesh& mesh, std::size_t number, const PieceOptions& options)
{
  return PieceReader(mesh, number, options).read();
}

} // namespace tipp
