// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionRun_h
#define tippPartitionRun_h

#include "Partition/BoxTiling.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/PartitionMesh.h"
#include "Partitioning/Ranks.h"
#include "Partitioning/Spill.h"

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
  int Corners = 3;
  int Dimension = 2;          ///< the tiling's
  std::size_t IdBytes = 4;    ///< size of an id in a cell's row: 8 if 31 bits do not suffice
  std::size_t CellBytes = 0;  ///< the cell's id, its vertices' ids, its attributes
  std::size_t CellData = 0;   ///< offset of its attributes
  std::size_t PointBytes = 0; ///< 8 bytes of id and flags, coordinates, attributes

  /// Flags in the two lowest bits of a point's id.
  static constexpr std::uint64_t Foreign = 1;   ///< the point belongs to another piece
  static constexpr std::uint64_t GhostOnly = 2; ///< no owned cell of the piece uses it

  char* putId(std::int64_t id, char* to) const
  {
    std::memcpy(to, &id, this->IdBytes); // little-endian
    return to + this->IdBytes;
  }
  std::int64_t id(const char* row, std::size_t place) const
  {
    std::int64_t value = 0;
    std::memcpy(&value, row + place * this->IdBytes, this->IdBytes);
    return value;
  }
};

/// The state that the phases of partitionMesh() share on one rank.
struct PartitionRun
{
  /// `folder` is the temporary output folder.
  PartitionRun(const FlatMesh& mesh, const PartitionOptions& options, const Ranks& ranks,
    const std::string& folder);

  const FlatMesh& Mesh;
  const PartitionOptions& Options;
  Ranks Team;
  int Threads;
  std::string Folder;
  RowLayout Rows;
  PartitionedMesh Result; ///< complete except for the pieces' counts before the cells are read
  std::optional<BoxTiling> Tiling;
  /// the arrays that Result.Arrays lists, including the steps of series
  std::vector<RawArray> PointData;
  std::vector<RawArray> CellData;
  std::int64_t ChunkCells = 1;
  std::int64_t ChunkPoints = 1;
  PartitionStatistics Statistics;
  double Fraction = 0; ///< fraction of the work done

  // Keyed by piece; ForeignPoints by chunk of points.
  std::optional<Spill> Cells; ///< cells that lie in one partition
  /// owned and borrowed, followed by 4 bytes: the number of borrowers
  std::optional<Spill> SharedCells;
  std::optional<Spill> Borrowers;     ///< of SharedCells, consecutively, 4 bytes each
  std::optional<Spill> BorrowedCells; ///< if they are duplicated
  std::optional<Spill> ForeignPoints;
  std::optional<Spill> Points;

  std::string scratch(const std::string& name) const { return this->Folder + "/." + name; }
  RawArray homes() const;
  LoaderOptions loaderOptions() const;
  std::size_t pieces() const { return this->Result.Pieces.size(); }
  /// Reports the progress. Throws WorkAborted if the caller asks to stop.
  void report(double fraction);
};

} // namespace tipp

#endif
