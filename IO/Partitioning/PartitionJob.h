// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionJob_h
#define tippPartitionJob_h

#include "Flat/FlatMesh.h"
#include "Parallel/ParallelFor.h"
#include "Partition/BoxTiling.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/PartitionOptions.h"
#include "Ranks/Communicator.h"
#include "Ranks/Spill.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The layout of cells and points in the rows that are spilled. Rows are not aligned.
struct RowLayout
{
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
    const std::string& folder)
    : Mesh(mesh)
    , Options(options)
    , Team(ranks)
    , Threads(threadCount(options.Threads))
    , Folder(folder)
  {
  }

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

} // namespace tipp

#endif
