// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBorrowedByReference_h
#define tippBorrowedByReference_h

#include "Partitioned/PieceFile.h"
#include "Partitioned/ReadPiece.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace tipp
{

/// Reads the cells that a piece borrows, and their points, from their owners' files. An owner
/// stores cells with the same set of borrowers contiguously, and so their points: each group of an
/// array is one read.
class BorrowedByReference
{
public:
  /// Reads the borrowed cells' and points' global ids; `ownIds` are the global ids of the piece's
  /// own points. Throws IOError.
  BorrowedByReference(const PartitionedMesh& mesh, const PieceFile& piece,
    const std::int64_t* ownIds, ReadCounters& counters);

  /// Number of points that are not among the piece's own, and of cells.
  std::int64_t pointCount() const { return std::int64_t(this->NewPoints.size()); }
  std::int64_t cellCount() const { return std::int64_t(this->CellOrder.size()); }

  /// Appends them to a piece whose buffers have room for them.
  void fill(Piece& piece) const;

private:
  struct Run
  {
    std::int64_t InOwner; ///< first tuple in the owner's array
    std::int64_t First;   ///< index among all borrowed tuples
    std::int64_t Count;
    std::size_t Part;
  };
  struct Source
  {
    const PieceFile* File;
    std::vector<Run> PointRuns; ///< ascending
    std::vector<Run> CellRuns;
  };

  void addRuns(const PartitionedMesh& mesh, const PieceFile& piece, bool ofPoints);
  Source& sourceOf(const PartitionedMesh& mesh, std::int32_t owner);
  std::vector<std::int64_t> readIds(PieceRole role, bool ofPoints) const;
  void matchPoints(const std::vector<std::int64_t>& ids, const std::int64_t* ownIds);
  template <typename Id>
  void addCells(const Source& source, const Run& run, Piece& piece) const;
  void copyTuples(bool ofPoints, const std::vector<std::int64_t>& places,
    const std::vector<std::size_t>& arrays, char* to) const;
  std::vector<std::size_t> arraysOf(PieceRole role) const;
  std::vector<std::size_t> arraysOf(const StoredArray& attribute) const;

  const PartitionedMesh& Mesh;
  const PieceFile& Own;
  ReadCounters& Counters;
  std::deque<PieceFile> Files;
  std::vector<Source> Sources;
  std::int64_t Candidates = 0;           ///< borrowed points, as read
  std::int64_t BorrowedCells = 0;        ///< borrowed cells, as read
  std::vector<std::int64_t> PointPlaces; ///< index in the piece of each candidate
  std::vector<std::int64_t> NewPoints;   ///< global ids, ascending
  /// indices of the borrowed cells, as read, sorted by global id
  std::vector<std::int64_t> CellOrder;
  std::vector<std::int64_t> CellPlaces; ///< index in the piece of each borrowed cell, as read
  std::vector<std::int64_t> CellIds;    ///< global ids, as read
};

} // namespace tipp

#endif
