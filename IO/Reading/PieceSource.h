// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceSource_h
#define tippPieceSource_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/MeshTiling.h"
#include "Partitioning/Ranks.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

struct SourceOptions
{
  TilingChoice Tiling; ///< of a flat mesh; a partitioned one has its own
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30; ///< in bytes, without the pieces themselves
  int Threads = 0;                                    ///< 0: OpenMP's default
};

/// A source of pieces: a partitioned mesh on disk, or a flat mesh that is partitioned as it is
/// read. Both give the same pieces, except for the order of points and cells in them.
class PieceSource
{
public:
  PieceSource() = default;
  virtual ~PieceSource();
  PieceSource(const PieceSource&) = delete;
  PieceSource& operator=(const PieceSource&) = delete;

  /// Arrays and times are known after construction, pieces after prepare().
  const PartitionedMesh& mesh() const { return this->Mesh; }

  /// Collective; must precede weights() and read(). Throws IOError.
  virtual void prepare(const Ranks& ranks) = 0;
  /// The work that each piece takes, for load balancing.
  virtual std::vector<std::int64_t> weights() const = 0;
  /// Returns the pieces with these indices. Throws IOError.
  virtual std::vector<Piece> read(
    const std::vector<std::size_t>& numbers, const PieceOptions& options) = 0;

protected:
  PartitionedMesh Mesh;
};

/// Opens a partitioned or a flat mesh; throws IOError.
std::unique_ptr<PieceSource> openPieceSource(
  const std::string& path, const SourceOptions& options = {});

} // namespace tipp

#endif
