// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpilledPieceWriter_h
#define tippSpilledPieceWriter_h

#include "Partitioned/GlobalIdMap.h"
#include "Partitioned/PieceBorder.h"
#include "Partitioned/PieceFormat.h"
#include "Partitioned/PieceWriter.h"
#include "Partitioning/PartitionJob.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// Writes one piece's file from its spilled rows. Only its points' ids, its shared and borrowed
/// cells and their points are held in memory; the rest is streamed.
class SpilledPieceWriter
{
public:
  SpilledPieceWriter(const PartitionJob& job, std::size_t piece, std::size_t bufferBytes)
    : Job(job)
    , Piece(piece)
    , BufferBytes(bufferBytes)
    , Corners(static_cast<std::size_t>(job.Rows.Corners))
  {
  }

  /// Writes the file. Throws IOError. Afterwards summary() and table() are complete except for the
  /// borrowed groups.
  void write();

  const PieceSummary& summary() const { return this->Summary; }
  const PieceTable& table() const { return this->Table; }

private:
  using RowPointers = std::vector<const char*>;

  void takePointIds();
  void takeSharedCells();
  void sharePoints();
  void orderPoints();
  void countCells();
  void writePoints();
  void writeCells();
  void appendPoints(const RowPointers& rows);
  void appendPointArray(const RowPointers& rows, const PieceArray& array, char* to) const;
  void extendBounds(const RowPointers& rows);
  void appendCells(const RowPointers& rows, bool ghosts);
  void appendCellArray(const RowPointers& rows, const PieceArray& array, bool ghosts, char* to);
  template <typename Id>
  void appendLocalIds(const RowPointers& rows, const PieceArray& array, char* to);
  void appendInBlocks(const RowPointers& rows, bool ofPoints, bool ghosts);
  std::size_t partOf(std::size_t point) const;
  std::size_t dataOffset(const PieceArray& array) const;

  const PartitionJob& Job;
  std::size_t Piece;
  std::size_t BufferBytes;
  std::size_t Corners;
  PieceSummary Summary;
  PieceTable Table;
  std::vector<std::int64_t> PointIds; ///< global ids, ascending
  std::vector<std::uint8_t> PointFlags;
  std::vector<char> SharedRows;
  std::vector<int> CellSets; ///< set of each shared cell
  SharingSets Sets;
  std::vector<int> PointSets;        ///< set of each point, or -1
  std::vector<int> PointGroupOf;     ///< per set: its index among the points' groups, or -1
  std::vector<std::int64_t> Indices; ///< index of each point in the piece
  GlobalIdMap Local;
  std::optional<PieceWriter> Writer;
  std::int64_t CellsWritten = 0;
};

} // namespace tipp

#endif
