// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceSource_h
#define tippPieceSource_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/Ranks.h"
#include "Partitioning/TilingChoice.h"

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
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30; ///< in bytes, besides the pieces themselves
  int Threads = 0;                                    ///< 0: OpenMP's choice
};

/// Where pieces come from: a partitioned mesh on disk, or a flat one that is partitioned as it is
/// read. Both give the same pieces, but for the order of the points and cells in them.
class PieceSource
{
public:
  PieceSource() = default;
  virtual ~PieceSource();
  PieceSource(const PieceSource&) = delete;
  PieceSource& operator=(const PieceSource&) = delete;

  /// Arrays and times are known from the beginning, pieces once they are prepared.
  const PartitionedMesh& mesh() const { return this->Mesh; }

  /// A call of all ranks, before weights() and read(). Throws IOError.
  virtual void prepare(const Ranks& ranks) = 0;
  /// How much work each piece is, for a fair share.
  virtual std::vector<std::int64_t> weights() const = 0;
  /// The pieces of these numbers. Throws IOError.
  virtual std::vector<Piece> read(
    const std::vector<std::size_t>& numbers, const PieceOptions& options) = 0;

protected:
  PartitionedMesh Mesh;
};

/// Opens either kind; throws IOError.
std::unique_ptr<PieceSource> openPieceSource(
  const std::string& path, const SourceOptions& options = {});

} // namespace tipp

#endif
