// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceFile_h
#define tippPieceFile_h

#include "Arrays/Buffer.h"
#include "Files/Checksum.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFormat.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

namespace tipp
{

/// A map from ids to values, neither negative. A look-up uses a table with about one id per entry,
/// and a search among the few ids that share an entry: two cache lines.
class VTKTIPPIO_EXPORT GlobalIdMap
{
public:
  GlobalIdMap() = default;
  /// `ids` must ascend; ids[i] maps to values[i], or to i if `values` is null.
  GlobalIdMap(const std::int64_t* ids, const std::int64_t* values, std::size_t count);

  /// The id's value; -1 if the id is not in the map.
  std::int64_t find(std::int64_t id) const;

  /// Writes the values of `count` ids; returns false if an id is not in the map. Value is
  /// std::int32_t or std::int64_t.
  template <typename Value>
  bool translate(const std::int64_t* ids, std::size_t count, Value* values) const;

private:
  template <typename Number>
  struct IdValue
  {
    Number Id; ///< minus the least id
    Number Value;
  };
  template <typename Number>
  std::int64_t search(const std::vector<IdValue<Number>>& entries, std::uint64_t key) const;
  template <typename Number>
  void fill(std::vector<IdValue<Number>>& entries, const std::int64_t* ids,
    const std::int64_t* values, std::size_t count);

  std::int64_t Least = 0;
  std::uint64_t Range = 0; ///< greatest id minus least id
  int Shift = 0;
  std::vector<std::uint32_t> Starts; ///< first entry for each value of the upper bits, and the end
  // Only one is used; the first if everything fits in 32 bits.
  std::vector<IdValue<std::uint32_t>> Narrow;
  std::vector<IdValue<std::uint64_t>> Wide;
};

/// A piece's open file, read part by part. Not thread-safe: reading counts the bytes.
class PieceFile
{
public:
  /// Reads the piece's table and checks the file's header; throws IOError.
  PieceFile(const PartitionedMesh& mesh, std::size_t number);
  /// For a mesh that is not published: with the summary, which must outlive this, and the table
  /// that the piece will have.
  PieceFile(
    const PartitionedMesh& mesh, std::size_t number, const PieceSummary& summary, PieceTable table);

  const PieceSummary& summary() const { return this->Summary; }
  const PieceTable& table() const { return this->Table; }
  const std::vector<PieceArray>& arrays() const { return this->Arrays; }
  /// Bytes read so far, including the table.
  std::int64_t bytesRead() const { return this->BytesRead; }
  /// The first tuple of each part of the arrays of points, or of cells, and the end of the last.
  const std::vector<std::int64_t>& partStarts(bool ofPoints) const
  {
    return ofPoints ? this->PointParts : this->CellParts;
  }

  /// The index of the array with a role other than data.
  std::size_t find(PieceRole role) const { return findArray(this->Arrays, role); }
  /// The index of the array of an attribute of the mesh.
  std::size_t findAttribute(std::size_t attribute) const { return this->OfAttribute[attribute]; }

  /// Reads parts [first, end) of an array and verifies their checksums; `to` may be null, to verify
  /// them only. Throws IOError.
  void read(std::size_t array, std::size_t first, std::size_t end, void* to) const;

  /// Receives `count` tuples, starting at index `first` of the visited ones. Returning false stops
  /// reading.
  using TakeTuples =
    std::function<bool(std::int64_t first, std::int64_t count, const char* tuples)>;
  /// Passes parts [first, end) of an array to `take` in small blocks, in order. Blocks are passed
  /// before they are verified, so results are valid only once this has returned. Throws IOError.
  void visit(std::size_t array, std::size_t first, std::size_t end, const TakeTuples& take) const;
  /// Verifies every byte of the file, except for arrays that have no checksums yet; throws IOError.
  void verifyAll() const;

  /// Throws IOError unless all global ids, which the file holds, are in [0, limit).
  void requireIds(const std::int64_t* ids, std::size_t count, std::int64_t limit) const;

  [[noreturn]] void fail(const std::string& problem) const;

private:
  template <typename BlockAt, typename Take>
  void readBlocks(std::size_t array, std::size_t first, std::size_t end, const BlockAt& blockAt,
    const Take& take) const;
  void requirePart(std::size_t array, std::size_t part, std::uint64_t checksum) const;
  void requireZeros(std::uint64_t from, std::uint64_t to) const;

  const PieceSummary& Summary;
  std::size_t Number;
  InputFile File;
  PieceTable Table;
  std::vector<PieceArray> Arrays;
  std::vector<std::size_t> OfAttribute; ///< by attribute of the mesh: index of its array
  std::vector<std::int64_t> PointParts;
  std::vector<std::int64_t> CellParts;
  mutable std::int64_t BytesRead = 0;
};

/// The usual size of a ColumnWriter's buffer.
constexpr std::size_t columnBufferBytes = std::size_t(1) << 20;

/// Writes one array of a file sequentially through a buffer, and computes a checksum for each of
/// its parts.
class ColumnWriter
{
public:
  /// `offset` and `bufferBytes` are in bytes. The file must outlive this.
  ColumnWriter(const OutputFile& file, std::uint64_t offset, std::size_t bufferBytes);

  /// Returns the buffer for the next bytes, which the caller must fill before the next call. Throws
  /// IOError.
  char* extend(std::size_t bytes);
  void endPart();
  /// Writes the buffered bytes.
  void flush();
  std::vector<std::uint64_t>& checksums() { return this->Checksums; }

private:
  const OutputFile& File;
  std::uint64_t Offset;
  Buffer<char> Unwritten; ///< the first `Used` bytes; not cleared, as most pieces fill little of it
  std::size_t Used = 0;
  std::size_t Hashed = 0;
  Checksum Part;
  std::vector<std::uint64_t> Checksums;
};

/// Writes the header before the arrays and the footer after them, and completes the offsets in the
/// piece's table. Returns the file's size in bytes. Throws IOError.
std::uint64_t writeFrame(const OutputFile& file, const PieceLayout& layout, PieceTable& table);

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
