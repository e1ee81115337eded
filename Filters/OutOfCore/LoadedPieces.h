// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLoadedPieces_h
#define tippLoadedPieces_h

#include "Distributed/SeamGroups.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SpillPoints.h"
#include "Partitioned/GrowingPiece.h"
#include "Triangulation/Worker.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace tipp
{

/// What a run's pieces are made of and go to; the same on all ranks.
struct PieceWork
{
  const PiecePlan& Plan;
  const SpilledPoints& Points;
  double Factor; ///< of coordinates
  const PointRowLayout& Rows;
  const PartitionedMesh& Mesh;
};

/// What a worker has made of a partition, but for what stays with its piece.
struct PartitionResult
{
  PartitionIndex Partition = 0;
  SeamGroups Seams;
  std::int64_t Points = 0;
  std::int64_t Duplicates = 0;
  std::int64_t Vertices = 0;
};

/// What a piece's interior is written with, beside the piece itself, when its partitions are
/// finished. Points are counted from the piece's first one on.
struct InteriorTask
{
  PartitionIndex Piece = 0;
  std::vector<std::int32_t> Rim;                  ///< points on the rim, ascending
  std::vector<std::array<std::int32_t, 3>> Seams; ///< triangles that meet no other piece
};

/// The pieces that a process has in memory. All methods may be called by several threads at once,
/// but not for a piece that is being loaded, written or not there.
class VTKTIPPFILTERS_EXPORT LoadedPieces
{
public:
  explicit LoadedPieces(const PieceWork& work);
  ~LoadedPieces();

  /// Bytes that a piece takes in memory.
  std::uint64_t bytesOf(PartitionIndex piece) const;

  /// Finished: those of its partitions that a run before this one has triangulated.
  void load(PartitionIndex piece, const std::vector<PartitionIndex>& finished);

  /// What one thread triangulates with.
  struct Place
  {
    PartitionIndex Piece = -1;
    std::unique_ptr<Worker<std::int32_t>> Triangulator; ///< for that piece
    SeamGrouping Grouping;
    std::vector<PlainVertex> Vertices; ///< of the triangles that belong to the partition
  };
  PartitionResult triangulate(Place& place, PartitionIndex partition);

  /// Writes the interior's share of the piece's file and frees the piece.
  GrowingPiece writeInterior(const InteriorTask& task);

  /// @name A piece without a border
  ///@{
  /// Points on one line: there are no triangles. Returns how many are duplicates.
  std::int64_t writePointsAlone(PartitionIndex piece, FinishedPiece& finished);
  /// The only piece, of one partition without artificial points. False if the monitor ended it.
  bool triangulateAlone(
    const DelaunayKernel::Monitor& proceed, PartitionResult& result, FinishedPiece& finished);
  ///@}

private:
  struct Loaded;

  void prepare(Place& place, PartitionIndex piece);
  std::unique_ptr<Loaded> read(PartitionIndex piece) const;
  void makeInteriors(
    PartitionIndex piece, const std::vector<PartitionIndex>& finished, Loaded& loaded) const;
  GrowingPiece write(const InteriorTask& task, Loaded& loaded) const;

  const PieceWork Work;
  std::vector<std::unique_ptr<Loaded>> Pieces;
};

} // namespace tipp

#endif
