// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionJob_h
#define tippPartitionJob_h

#include "Files/InputFile.h"
#include "Flat/FlatMesh.h"
#include "Partition/BoxTiling.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceBorder.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/PieceFormat.h"
#include "Partitioned/PieceWriter.h"
#include "Partitioning/PartitionMesh.h"
#include "Partitioning/Spill.h"
#include "Ranks/Communicator.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// A range of tuples of several arrays in memory, copied out row by row. A row is one tuple of each
/// array.
class ArrayRows
{
public:
  /// Throws IOError if a file cannot be opened.
  explicit ArrayRows(std::vector<RawArray> arrays);

  /// The size of a row in bytes.
  std::size_t rowBytes() const { return this->RowBytes; }

  /// Reads tuples [first, first + count) of each array. Throws IOError.
  void read(std::int64_t first, std::int64_t count, int threads);

  /// Copies the row at index `index` of the range to `to`; returns the end of the copy.
  char* copyRow(std::size_t index, char* to) const
  {
    for (std::size_t a = 0; a < this->Arrays.size(); ++a)
    {
      const std::size_t bytes = this->Bytes[a];
      std::memcpy(to, this->Values[a].data() + index * bytes, bytes);
      to += bytes;
    }
    return to;
  }

private:
  std::vector<RawArray> Arrays;
  std::vector<std::size_t> Bytes;
  std::size_t RowBytes = 0;
  std::map<std::string, std::unique_ptr<InputFile>> Files;
  std::vector<std::vector<char>> Values;
};

/// A ghost point: a vertex that a piece needs but does not own.
struct GhostPoint
{
  std::int64_t Point;     ///< global point id
  std::int32_t Piece;     ///< index of the piece that needs it
  std::int32_t GhostOnly; ///< 1 if only borrowed cells use it, else 0
};

/// Sorts by point, then piece, and removes duplicates: several cells may need a point. A point that
/// an owned cell uses is not GhostOnly.
void makeDistinct(std::vector<GhostPoint>& points);

/// The layout of cells and points in the rows that are spilled. Rows are not aligned.
struct RowLayout
{
  int Corners = 3;            ///< vertices per cell
  int Dimension = 2;          ///< the tiling's
  std::size_t IdBytes = 4;    ///< size of an id in a cell's row: 8 if 31 bits do not suffice
  std::size_t CellBytes = 0;  ///< the cell's id, its vertices' ids, its attributes
  std::size_t CellData = 0;   ///< offset of its attributes
  std::size_t PointBytes = 0; ///< 8 bytes of id and flags, coordinates, attributes

  /// Flags in the two lowest bits of a point's id.
  static constexpr std::uint64_t Ghost = 1;     ///< the point belongs to another piece
  static constexpr std::uint64_t GhostOnly = 2; ///< no owned cell of the piece uses it

  char* putId(std::int64_t id, char* to) const
  {
    std::memcpy(to, &id, this->IdBytes); // little-endian
    return to + this->IdBytes;
  }
  std::int64_t id(const char* row, std::size_t index) const
  {
    std::int64_t value = 0;
    std::memcpy(&value, row + index * this->IdBytes, this->IdBytes);
    return value;
  }
};

/// The state that the phases of partitionMesh() share on one rank.
struct PartitionJob
{
  /// `folder` is the temporary output folder.
  PartitionJob(const FlatMesh& mesh, const PartitionOptions& options, Communicator& ranks,
    const std::string& folder);

  const FlatMesh& Mesh;
  const PartitionOptions& Options;
  Communicator& Team;
  int Threads;
  std::string Folder; ///< the temporary output folder
  RowLayout Rows;
  PartitionedMesh Result; ///< complete except for the pieces' counts before the cells are read
  std::optional<BoxTiling> Tiling;
  /// the arrays that Result.Arrays lists, including the steps of series
  std::vector<RawArray> PointData;
  std::vector<RawArray> CellData;
  std::int64_t ChunkCells = 1;  ///< cells that are read at once
  std::int64_t ChunkPoints = 1; ///< points that are read at once
  PartitionStatistics Statistics;
  double Fraction = 0; ///< fraction of the work done

  // Keyed by piece; GhostPoints by chunk of points.
  std::optional<Spill> Cells; ///< cells that lie in one partition
  /// cells with borrowers: each followed by 4 bytes, the number of borrowers
  std::optional<Spill> SharedCells;
  std::optional<Spill> Borrowers;     ///< borrowers of SharedCells, consecutively, 4 bytes each
  std::optional<Spill> BorrowedCells; ///< if they are duplicated
  std::optional<Spill> GhostPoints;
  std::optional<Spill> Points;

  std::string scratch(const std::string& name) const { return this->Folder + "/." + name; }
  RawArray owners() const;
  LoaderOptions loaderOptions() const;
  std::size_t pieces() const { return this->Result.Pieces.size(); }
  /// Reports the progress. Throws WorkAborted if the caller asks to stop.
  void report(double fraction);
};

/// Reads this rank's share of the cells chunk by chunk and spills each cell to the pieces that own
/// and borrow it, and the vertices that these need from other partitions. Collective. Throws
/// IOError.
///
/// A cell whose vertices all lie in one partition, and in no other, lies inside it, since
/// partitions are convex. For any other cell the coordinates determine which partitions it meets.
void distributeCells(PartitionJob& job);

/// Reads this rank's share of the points in one pass and spills each to its owner and to the other
/// pieces that need it. Collective. Throws IOError.
void distributePoints(PartitionJob& job);

/// Writes the pieces' files, each rank a share of equal weight; then the first rank writes tables,
/// .pvtu and index. All are synced on return. Collective. Throws IOError.
void writePieces(PartitionJob& job);

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
