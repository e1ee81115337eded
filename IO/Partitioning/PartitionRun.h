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

/// How cells and points stand in the rows that are spilled. Nothing in them is aligned.
struct RowLayout
{
  int Corners = 3;
  int Dimension = 2;          ///< of the tiling
  std::size_t IdBytes = 4;    ///< of ids in rows of cells: 8 where 31 bits do not do
  std::size_t CellBytes = 0;  ///< the cell's id, its vertices', its attributes
  std::size_t CellData = 0;   ///< where its attributes begin
  std::size_t PointBytes = 0; ///< 8 bytes of id and flags, coordinates, attributes

  /// Flags in the two lowest bits of a point's id.
  static constexpr std::uint64_t Foreign = 1;   ///< the point belongs to another piece
  static constexpr std::uint64_t GhostOnly = 2; ///< no owned cell of the piece has it

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

/// One run of partitionMesh on one rank: what its phases share.
struct PartitionRun
{
  /// `folder` is the temporary one.
  PartitionRun(const FlatMesh& mesh, const PartitionOptions& options, const Ranks& ranks,
    const std::string& folder);

  const FlatMesh& Mesh;
  const PartitionOptions& Options;
  Ranks Team;
  int Threads;
  std::string Folder;
  RowLayout Rows;
  PartitionedMesh Result; ///< all but the pieces' counts is known before the cells are read
  std::optional<BoxTiling> Tiling;
  std::vector<RawArray> PointData; ///< as Result.Arrays names them, the steps of series too
  std::vector<RawArray> CellData;
  std::int64_t ChunkCells = 1;
  std::int64_t ChunkPoints = 1;
  PartitionStatistics Statistics;
  double Fraction = 0; ///< that is done

  // Keyed by piece; ForeignPoints by chunk of points.
  std::optional<Spill> Cells;         ///< those that lie in one partition
  std::optional<Spill> SharedCells;   ///< owned, followed by 4 bytes: the number of borrowers
  std::optional<Spill> Borrowers;     ///< of SharedCells, one after the other, 4 bytes each
  std::optional<Spill> BorrowedCells; ///< where they are duplicated
  std::optional<Spill> ForeignPoints;
  std::optional<Spill> Points;

  std::string scratch(const std::string& name) const { return this->Folder + "/." + name; }
  RawArray homes() const;
  LoaderOptions loaderOptions() const;
  std::size_t pieces() const { return this->Result.Pieces.size(); }
  /// Tells the caller how far the run is. Throws WorkAborted when told to stop.
  void report(double fraction);
};

} // namespace tipp

#endif
