// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceWriter_h
#define tippPieceWriter_h

#include "Arrays/Buffer.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Partitioned/Checksum.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFormat.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

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

/// The folders that a new mesh may replace: partitioned meshes.
VTKTIPPIO_EXPORT extern const Replaceable replaceableMesh;

/// A piece whose file is complete, with its summary and table except for what it borrows.
struct FinishedPiece
{
  PieceSummary Summary;          ///< the piece's entry in the index
  PieceTable Table;              ///< without checksums of arrays that are not written yet
  std::uint64_t TriangleSum = 0; ///< without a file: sum of hashTriangle()

  /// The number of parts of its arrays of cells.
  std::size_t cellParts() const { return 1 + this->Table.CellGroups.size(); }
};

template <typename Archive>
void serialize(Archive& archive, FinishedPiece& piece)
{
  PieceTable& table = piece.Table;
  archive(piece.Summary, table.Offsets, table.PointGroups, table.CellGroups, table.Checksums,
    table.HeaderBytes, table.HeaderChecksum, piece.TriangleSum);
}

/// Writes parts [parts.first, parts.second) of the array with index `a` of a piece's cells into its
/// file, and their checksums into its table: writeNext(to, bytes) writes the tuple of the next
/// cell. Throws IOError.
template <typename WriteNext>
void writeCellParts(const PartitionedMesh& mesh, std::size_t number, std::size_t a,
  std::pair<std::size_t, std::size_t> parts, FinishedPiece& piece, WriteNext writeNext)
{
  const std::size_t bytes = pieceArrays(mesh, piece.Summary)[a].tupleBytes();
  const std::vector<std::int64_t> counts = piece.Table.parts(mesh, piece.Summary, false);
  const auto begin = counts.begin() + std::ptrdiff_t(parts.first);
  const auto end = counts.begin() + std::ptrdiff_t(parts.second);
  const std::int64_t skipped = std::accumulate(counts.begin(), begin, std::int64_t(0));
  const OutputFile file = OutputFile::shared(mesh.piecePath(number));
  ColumnWriter column(
    file, piece.Table.Offsets[a] + std::uint64_t(skipped) * bytes, columnBufferBytes);
  for (auto count = begin; count != end; ++count)
  {
    for (std::int64_t i = 0; i < *count; ++i)
    {
      writeNext(column.extend(bytes), bytes);
    }
    column.endPart();
  }
  column.flush();
  file.startWriteback();
  std::vector<std::uint64_t>& checksums = piece.Table.Checksums[a];
  checksums.resize(parts.first);
  checksums.insert(checksums.end(), column.checksums().begin(), column.checksums().end());
}

/// The result of publishPieces().
struct PublishedMesh
{
  std::uint64_t Bytes = 0;       ///< size of all files
  std::uint64_t Fingerprint = 0; ///< checksum of the index, which identifies the mesh
};

/// Writes tables, .pvtu and, last, the index into the mesh's folder, and completes mesh.Pieces. The
/// pieces' files must have been synced. Throws IOError if writing fails or one of them does not
/// have its expected size.
VTKTIPPIO_EXPORT PublishedMesh publishPieces(
  PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces);

/// Whether the folder holds the mesh with this fingerprint, and each of its files has its expected
/// size.
VTKTIPPIO_EXPORT bool holdsMesh(const std::string& path, std::uint64_t fingerprint);

/// Throws IOError unless the folder holds the mesh with this fingerprint and every byte of its
/// files is intact.
VTKTIPPIO_EXPORT void verifyMesh(const std::string& path, std::uint64_t fingerprint, int threads);

} // namespace tipp

#endif
