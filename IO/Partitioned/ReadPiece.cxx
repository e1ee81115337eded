// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/ReadPiece.h"

#include "Files/RawArray.h"
#include "Parallel/Sort.h"
#include "Partitioned/PieceFile.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>

namespace tipp
{
namespace
{

/// Reads the cells that a piece borrows by reference, and their points, from their owners' files.
/// An owner stores cells with the same set of borrowers contiguously, and so their points: each
/// group of an array is one read.
class BorrowedCells
{
public:
  /// Reads the borrowed cells' and points' global ids; `ownIds` are the global ids of the piece's
  /// own points. Throws IOError.
  BorrowedCells(const PartitionedMesh& mesh, const PieceFile& piece, const std::int64_t* ownIds)
    : Mesh(mesh)
    , Own(piece)
  {
    this->addRuns(true);
    this->addRuns(false);
    if (this->CellsAsRead != piece.summary().BorrowedCells)
    {
      piece.fail("borrows another number of cells than the index says");
    }
    this->matchPoints(this->readIds(PieceRole::PointIds, true), ownIds);
    this->CellIds = this->readIds(PieceRole::CellIds, false);
    this->orderCells();
  }

  /// The numbers of borrowed points that are not among the piece's own points, and of borrowed
  /// cells.
  std::int64_t pointCount() const { return std::int64_t(this->NewPoints.size()); }
  std::int64_t cellCount() const { return std::int64_t(this->CellIds.size()); }

  /// Bytes read so far.
  std::int64_t bytesRead() const
  {
    return std::accumulate(this->Sources.begin(), this->Sources.end(), std::int64_t(0),
      [](std::int64_t bytes, const auto& source)
      { return bytes + source.second.File.bytesRead(); });
  }

  /// Copies the borrowed tuples of an array to the piece's buffer of it, which has room for them.
  /// `array` is its index among a piece's arrays, which is the same in all pieces.
  void copyTuples(std::size_t array, std::int64_t ownedCells, char* to) const
  {
    const PieceArray& description = this->Own.arrays()[array];
    const bool ofPoints = description.ofPoints();
    const std::vector<std::int64_t>& indices = ofPoints ? this->PointIndices : this->CellIndices;
    const std::int64_t first = ofPoints ? 0 : ownedCells;
    const std::size_t bytes = description.tupleBytes();
    std::vector<char> tuples;
    for (const auto& [owner, source] : this->Sources)
    {
      for (const BorrowedRun& run : source.runs(ofPoints))
      {
        tuples.resize(std::size_t(run.Count) * bytes);
        source.File.read(array, run.Part, run.Part + 1, tuples.data());
        for (std::size_t i = 0; i < std::size_t(run.Count); ++i)
        {
          const std::size_t index = std::size_t(first + indices[std::size_t(run.First) + i]);
          std::memcpy(to + index * bytes, tuples.data() + i * bytes, bytes);
        }
      }
    }
  }

  /// Appends ids, ghost marks and connectivity to a piece whose buffers have room for them.
  void addIds(Piece& piece) const
  {
    const std::size_t own = std::size_t(piece.OwnedPoints);
    if (!piece.PointIds.empty())
    {
      std::copy(
        this->NewPoints.begin(), this->NewPoints.end(), piece.PointIds.as<std::int64_t>() + own);
      std::memset(piece.PointGhosts.data() + own, 1, this->NewPoints.size());
    }
    for (std::size_t i = 0; i < this->CellIds.size(); ++i)
    {
      piece.CellIds.as<std::int64_t>()[piece.OwnedCells + this->CellIndices[i]] = this->CellIds[i];
    }
    for (const auto& [owner, source] : this->Sources)
    {
      const bool wide = hasWideIds(this->Mesh, source.File.summary());
      for (const BorrowedRun& run : source.CellRuns)
      {
        wide ? this->addCells<std::int64_t>(source, run, piece)
             : this->addCells<std::int32_t>(source, run, piece);
      }
    }
  }

private:
  /// A group of tuples that the piece borrows.
  struct BorrowedRun
  {
    std::int64_t InOwner; ///< first tuple in the owner's array
    std::int64_t First;   ///< index among all borrowed tuples, as read
    std::int64_t Count;
    std::size_t Part; ///< index of the part in the owner's arrays
  };
  struct Source
  {
    Source(const PartitionedMesh& mesh, std::int32_t owner)
      : File(mesh, std::size_t(owner))
    {
    }

    const PieceFile File;
    std::vector<BorrowedRun> PointRuns; ///< ascending
    std::vector<BorrowedRun> CellRuns;

    const std::vector<BorrowedRun>& runs(bool ofPoints) const
    {
      return ofPoints ? this->PointRuns : this->CellRuns;
    }
  };

  void addRuns(bool ofPoints)
  {
    const PieceTable& own = this->Own.table();
    for (const BorrowedGroup& group : ofPoints ? own.BorrowedPoints : own.BorrowedCells)
    {
      Source& source =
        this->Sources.try_emplace(group.Owner, this->Mesh, group.Owner).first->second;
      const PieceTable& table = source.File.table();
      const std::size_t groups = (ofPoints ? table.PointGroups : table.CellGroups).size();
      if (std::size_t(group.Group) >= groups)
      {
        this->Own.fail("borrows a group that its owner, piece " + std::to_string(group.Owner) +
          ", does not lend");
      }
      const std::size_t part = std::size_t(group.Group) + 1;
      const std::vector<std::int64_t>& starts = source.File.partStarts(ofPoints);
      std::int64_t& count = ofPoints ? this->PointsAsRead : this->CellsAsRead;
      const BorrowedRun run{ starts[part], count, starts[part + 1] - starts[part], part };
      (ofPoints ? source.PointRuns : source.CellRuns).push_back(run);
      count += run.Count;
    }
  }

  std::vector<std::int64_t> readIds(PieceRole role, bool ofPoints) const
  {
    std::vector<std::int64_t> ids(std::size_t(ofPoints ? this->PointsAsRead : this->CellsAsRead));
    for (const auto& [owner, source] : this->Sources)
    {
      for (const BorrowedRun& run : source.runs(ofPoints))
      {
        std::int64_t* const to = ids.data() + std::size_t(run.First);
        source.File.read(source.File.find(role), run.Part, run.Part + 1, to);
        source.File.requireIds(
          to, std::size_t(run.Count), ofPoints ? this->Mesh.Points : this->Mesh.Cells);
      }
    }
    return ids;
  }

  /// Finds each borrowed point's index in the piece: among its own points, or after them.
  void matchPoints(const std::vector<std::int64_t>& ids, const std::int64_t* ownIds)
  {
    const std::vector<std::int64_t> distinct = sortedUnique(ids);
    const GlobalIdMap borrowed(distinct.data(), nullptr, distinct.size());
    std::vector<std::int64_t> indices(distinct.size(), -1);
    const std::int64_t own = this->Own.summary().Points;
    for (std::int64_t i = 0; i < own; ++i)
    {
      const std::int64_t found = borrowed.find(ownIds[i]);
      if (found >= 0)
      {
        indices[std::size_t(found)] = i;
      }
    }
    for (std::size_t i = 0; i < distinct.size(); ++i)
    {
      if (indices[i] < 0)
      {
        indices[i] = own + this->pointCount();
        this->NewPoints.push_back(distinct[i]);
      }
    }
    this->PointIndices.resize(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      this->PointIndices[i] = indices[std::size_t(borrowed.find(ids[i]))];
    }
  }

  /// Borrowed cells follow the piece's own ones, by global id.
  void orderCells()
  {
    std::vector<std::int64_t> order(this->CellIds.size());
    std::iota(order.begin(), order.end(), std::int64_t(0));
    std::sort(order.begin(), order.end(),
      [this](std::int64_t a, std::int64_t b)
      { return this->CellIds[std::size_t(a)] < this->CellIds[std::size_t(b)]; });
    this->CellIndices.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      this->CellIndices[std::size_t(order[i])] = std::int64_t(i);
    }
  }

  template <typename Id>
  void addCells(const Source& source, const BorrowedRun& run, Piece& piece) const
  {
    const std::size_t corners = std::size_t(piece.CellSize);
    std::vector<Id> ids(std::size_t(run.Count) * corners);
    source.File.read(source.File.find(PieceRole::Connectivity), run.Part, run.Part + 1, ids.data());
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      const std::int64_t inOwner = ids[i];
      const auto after = std::upper_bound(source.PointRuns.begin(), source.PointRuns.end(), inOwner,
        [](std::int64_t point, const BorrowedRun& points) { return point < points.InOwner; });
      if (after == source.PointRuns.begin() || inOwner - (after - 1)->InOwner >= (after - 1)->Count)
      {
        source.File.fail("lends cells without their points");
      }
      const BorrowedRun& points = *(after - 1);
      const std::int64_t point =
        this->PointIndices[std::size_t(points.First + inOwner - points.InOwner)];
      const auto cell =
        std::size_t(piece.OwnedCells + this->CellIndices[std::size_t(run.First) + i / corners]);
      if (piece.WideIds)
      {
        piece.Connectivity.as<std::int64_t>()[cell * corners + i % corners] = point;
      }
      else
      {
        piece.Connectivity.as<std::int32_t>()[cell * corners + i % corners] = std::int32_t(point);
      }
    }
  }

  const PartitionedMesh& Mesh;
  const PieceFile& Own;
  std::map<std::int32_t, Source> Sources; ///< by the owner's index
  std::int64_t PointsAsRead = 0;          ///< borrowed points, with repetitions
  std::int64_t CellsAsRead = 0;           ///< borrowed cells
  std::vector<std::int64_t> PointIndices; ///< piece-local index of each point, as read
  std::vector<std::int64_t> NewPoints;    ///< global ids, ascending
  std::vector<std::int64_t> CellIndices;  ///< index among the borrowed cells of each cell, as read
  std::vector<std::int64_t> CellIds;      ///< global ids, as read
};

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
    this->Result.Coordinates = this->readAll(this->File.find(PieceRole::Points), false);
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
      if (this->Borrowed)
      {
        this->Borrowed->addIds(this->Result);
      }
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

  /// Reads an array's tuples, also those of borrowed points or cells.
  Buffer<char> readAll(std::size_t array, bool isChosen) const
  {
    Buffer<char> tuples = isChosen ? this->readChosen(array) : this->readOwn(array);
    if (this->Borrowed)
    {
      this->Borrowed->copyTuples(array, this->Result.OwnedCells, tuples.data());
    }
    return tuples;
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
        this->Result.Attributes.push_back({ this->Mesh.Arrays[i], this->readAll(array, isChosen) });
      }
    }
  }

  const PartitionedMesh& Mesh;
  const PieceOptions& Options;
  const PieceFile File;
  std::int64_t StoredPoints = 0; ///< that are in the file and needed
  std::int64_t StoredCells = 0;  ///< that are in the file and needed
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
  return readUnchanged(mesh, [&] { return PieceReader(mesh, number, options).read(); });
}

} // namespace tipp
