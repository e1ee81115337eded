// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBorrowedCells_h
#define tippBorrowedCells_h

#include "Arrays/SortUnique.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/ReadPiece.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace tipp
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

  /// Appends the borrowed points' coordinates to those of the piece, whose buffer has room for
  /// them.
  void fillCoordinates(Piece& piece) const
  {
    this->copyTuples(this->Own.find(PieceRole::Points), 0, piece.Coordinates.data());
  }

  /// Appends everything else to a piece whose buffers have room for it.
  void fill(const PieceOptions& options, Piece& piece) const
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
      for (const Run& run : source.CellRuns)
      {
        wide ? this->addCells<std::int64_t>(source, run, piece)
             : this->addCells<std::int32_t>(source, run, piece);
      }
    }
    auto attribute = piece.Attributes.begin();
    for (std::size_t i = 0; i < this->Mesh.Arrays.size(); ++i)
    {
      if (options.wants(this->Mesh, i))
      {
        char* const values = (attribute++)->Values.data();
        const std::size_t array = this->Own.findAttribute(i);
        const bool ofPoints = this->Own.arrays()[array].ofPoints();
        this->copyTuples(array, ofPoints ? 0 : piece.OwnedCells, values);
      }
    }
  }

private:
  /// A group of tuples that the piece borrows.
  struct Run
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
    std::vector<Run> PointRuns; ///< ascending
    std::vector<Run> CellRuns;

    const std::vector<Run>& runs(bool ofPoints) const
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
      const Run run{ starts[part], count, starts[part + 1] - starts[part], part };
      (ofPoints ? source.PointRuns : source.CellRuns).push_back(run);
      count += run.Count;
    }
  }

  std::vector<std::int64_t> readIds(PieceRole role, bool ofPoints) const
  {
    std::vector<std::int64_t> ids(std::size_t(ofPoints ? this->PointsAsRead : this->CellsAsRead));
    for (const auto& [owner, source] : this->Sources)
    {
      for (const Run& run : source.runs(ofPoints))
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

  /// Copies the borrowed tuples of an array to `to`. `array` is its index among a piece's arrays,
  /// which is the same in all pieces; `first` is subtracted from the tuples' indices.
  void copyTuples(std::size_t array, std::int64_t first, char* to) const
  {
    const PieceArray& description = this->Own.arrays()[array];
    const bool ofPoints = description.ofPoints();
    const std::vector<std::int64_t>& indices = ofPoints ? this->PointIndices : this->CellIndices;
    const std::size_t bytes = description.tupleBytes();
    std::vector<char> tuples;
    for (const auto& [owner, source] : this->Sources)
    {
      for (const Run& run : source.runs(ofPoints))
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

  template <typename Id>
  void addCells(const Source& source, const Run& run, Piece& piece) const
  {
    const std::size_t corners = std::size_t(piece.CellSize);
    std::vector<Id> ids(std::size_t(run.Count) * corners);
    source.File.read(source.File.find(PieceRole::Connectivity), run.Part, run.Part + 1, ids.data());
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      const std::int64_t inOwner = ids[i];
      const auto after = std::upper_bound(source.PointRuns.begin(), source.PointRuns.end(), inOwner,
        [](std::int64_t point, const Run& points) { return point < points.InOwner; });
      if (after == source.PointRuns.begin() || inOwner - (after - 1)->InOwner >= (after - 1)->Count)
      {
        source.File.fail("lends cells without their points");
      }
      const Run& points = *(after - 1);
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

} // namespace tipp

#endif
