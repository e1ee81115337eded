// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceWriter_h
#define tippPieceWriter_h

#include "Files/OutputFile.h"
#include "Partitioned/ColumnWriter.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceLayout.h"
#include "Partitioned/PieceTable.h"

#include <cstddef>
#include <deque>

namespace tipp
{

/// Writes a piece's file, whose counts are known, array by array in the order of tuples.
class PieceWriter
{
public:
  /// `bufferBytes` is per array. Throws IOError.
  PieceWriter(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& summary,
    std::size_t bufferBytes);

  const std::vector<PieceArray>& arrays() const { return this->Layout.Arrays; }
  /// Returns the buffer for the next bytes of an array, to be filled before the next call for this
  /// array.
  char* extend(std::size_t array, std::size_t bytes) { return this->Columns[array].extend(bytes); }
  void endPart(bool ofPoints);

  /// Completes the file, and the offsets and checksums in its table. Returns the file's size in
  /// bytes.
  std::uint64_t finish(PieceTable& table);

private:
  PieceLayout Layout;
  OutputFile File;
  std::deque<ColumnWriter> Columns;
};

} // namespace tipp

#endif
