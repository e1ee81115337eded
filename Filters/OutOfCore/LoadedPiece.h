// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLoadedPiece_h
#define tippLoadedPiece_h

#include "Engine/Routing.h"
#include "OutOfCore/PieceOrder.h"
#include "OutOfCore/PieceResult.h"
#include "Triangulation/Worker.h"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// A piece in memory: its points, whose partitions several threads triangulate, and what comes of
/// them until it is written.
class VTKTIPPFILTERS_EXPORT LoadedPiece
{
public:
  /// Reads the points. Throws IOError.
  LoadedPiece(const PieceWork& work, PartitionIndex piece);

  /// Bytes that a piece takes in memory.
  static std::uint64_t bytesOf(const PieceWork& work, PartitionIndex piece);

  /// What one thread triangulates with; kept for its memory from one partition to the next.
  struct Tools
  {
    explicit Tools(const PieceOrder& order)
      : Order(order)
    {
    }
    void clear()
    {
      this->Triangulator.reset();
      this->Router.reset();
      this->Unique = UniqueVertices();
    }

    const PieceOrder& Order;
    PartitionIndex Piece = -1;
    std::unique_ptr<Worker<std::int32_t>> Triangulator; ///< for that piece
    std::unique_ptr<Routing<std::int32_t>> Router;
    UniqueVertices Unique;
  };

  /// Triangulates a partition with what is in its inbox, and returns what it sends.
  SentMessages triangulate(
    Tools& tools, PartitionIndex partition, const std::vector<VertexMessage>& inbox);

  std::int64_t pointsOf(PartitionIndex partition) const
  {
    return std::int64_t(
      this->Buckets.count(partition - this->Work.Plan.FirstPartition[std::size_t(this->Piece)]));
  }

  /// When all partitions are triangulated: writes the interior's share of the piece's file in the
  /// mesh, frees the points, and gives what is left. Throws IOError.
  PieceResult write();

  /// @name A piece without a border
  ///@{
  /// Points on one line: there are no triangles.
  FinishedPiece writePointsAlone(PieceFigures& figures);
  /// The only piece, of one partition without artificial points. False if the monitor ended it.
  bool triangulateAlone(
    const DelaunayKernel::Monitor& proceed, PieceFigures& figures, FinishedPiece& finished);
  ///@}

private:
  struct Finals;

  void prepare(Tools& tools);
  std::vector<BoundaryVertex> uniqueVertices(Tools& tools, const std::vector<VertexMessage>& inbox);
  void take(const Finals& finals, const SentMessages& sent);
  void take(const std::vector<Duplicate>& duplicates);
  bool owns(const BoundaryVertex& v) const;
  void markRim(const BoundaryVertex& v);
  void dropLong();
  void resolveDuplicates(PieceFigures& figures);
  GrowingPiece writeInterior();

  const PieceWork& Work;
  const PartitionIndex Piece;
  const std::int64_t First; ///< index of the first point among all spilled ones
  Buffer<double> Rows;
  PointBuckets<std::int32_t> Buckets;
  std::vector<std::size_t> InteriorCounts; ///< triangles, of each partition

  std::mutex Mutex;                                               ///< for what follows
  std::unordered_map<std::int32_t, std::int32_t> Representatives; ///< of duplicates
  std::vector<std::uint8_t> Rim; ///< of each point: 1 if it is on the rim
  std::vector<std::array<std::int32_t, 3>>
    BoundaryTriangles; ///< between partitions, but of the interior
  PieceResult Result;
};

} // namespace tipp

#endif
