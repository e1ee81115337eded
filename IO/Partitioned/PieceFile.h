// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceFile_h
#define tippPieceFile_h

#include "Files/InputFile.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFormat.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The cost of reading a piece.
struct ReadCounters
{
  std::int64_t Reads = 0;
  std::int64_t Bytes = 0;
};

/// A piece's open file, which is read part by part.
class PieceFile
{
public:
  /// Reads the piece's table and checks the file's header; throws IOError.
  PieceFile(const PartitionedMesh& mesh, std::size_t number, ReadCounters& counters);
  /// For a mesh that is not published: with the summary, which must outlive this, and the table
  /// that the piece will have.
  PieceFile(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& summary,
    PieceTable table, ReadCounters& counters);

  const PieceSummary& summary() const { return this->Summary; }
  const PieceTable& table() const { return this->Table; }
  const std::vector<PieceArray>& arrays() const { return this->Arrays; }
  /// The first tuple of each part of the arrays of points, or of cells, and the end of the last.
  const std::vector<std::int64_t>& partStarts(bool ofPoints) const
  {
    return ofPoints ? this->PointParts : this->CellParts;
  }

  /// The index of the array with a role other than data.
  std::size_t find(PieceRole role) const;
  /// The index of the array of an attribute of the mesh.
  std::size_t findAttribute(std::size_t attribute) const;

  /// Reads parts [first, end) of an array and verifies their checksums; `to` may be null, to verify
  /// them only. Throws IOError.
  void read(std::size_t array, std::size_t first, std::size_t end, void* to) const;
  /// Verifies every byte of the file, except for arrays that have no checksums yet; throws IOError.
  void verifyAll() const;

  /// Throws IOError unless all global ids, which the file holds, are in [0, limit).
  void requireIds(const std::int64_t* ids, std::size_t count, std::int64_t limit) const;

  [[noreturn]] void fail(const std::string& problem) const;

private:
  void checkHeader() const;
  void requirePart(std::size_t array, std::size_t part, std::uint64_t checksum) const;
  void requireZeros(std::uint64_t from, std::uint64_t to) const;
  void requireFooter(std::uint64_t at) const;

  const PieceSummary& Summary;
  std::size_t Number;
  InputFile File;
  PieceTable Table;
  std::vector<PieceArray> Arrays;
  std::vector<std::int64_t> PointParts;
  std::vector<std::int64_t> CellParts;
  ReadCounters& Counters;
};

} // namespace tipp

#endif
