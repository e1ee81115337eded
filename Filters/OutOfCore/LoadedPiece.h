// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLoadedPiece_h
#define tippLoadedPiece_h

#include "Engine/Routing.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "Partitioned/PieceWriter.h"
#include "Triangulation/Worker.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// A piece in memory: its points, whose partitions several threads triangulate, and its triangles
/// until they are written.
class VTKTIPPFILTERS_EXPORT LoadedPiece
{
public:
  /// Reads the points. Throws IOError.
  LoadedPiece(const PieceWork& work, PartitionIndex piece);

  /// Bytes that a piece takes in memory.
  static std::uint64_t bytesOf(const PieceWork& work, PartitionIndex piece);

  /// A thread's memory, which is kept from one partition to the next.
  struct Workspace
  {
    explicit Workspace(const PieceOrder& order)
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
    Workspace& space, PartitionIndex partition, const std::vector<VertexMessage>& inbox);

  std::int64_t pointsOf(PartitionIndex partition) const
  {
    return std::int64_t(
      this->Buckets.count(partition - this->Work.Plan.FirstPartition[std::size_t(this->Piece)]));
  }

  /// When all partitions are triangulated: writes the interior's share of the piece's file in the
  /// mesh, frees the points, and returns the rest. Throws IOError.
  PieceResult write();

  /// @name A piece without a border
  /// Write the whole file.
  ///@{
  /// For points on one line: there are no triangles.
  FinishedPiece writePointsAlone(PieceFigures& figures);
  /// For the only piece, of one partition without artificial points. False if `progress` ended it.
  bool triangulateAlone(
    const DelaunayKernel::Monitor& progress, PieceFigures& figures, FinishedPiece& finished);
  ///@}

private:
  struct Finals;

  void prepare(Workspace& space);
  void take(Finals& finals, const SentMessages& sent);
  void take(const std::vector<Duplicate>& duplicates);
  bool owns(const BoundaryVertex& v) const;
  void markInterface(const BoundaryVertex& v);
  template <typename Filter>
  void filterTriangles(const Filter& filter);
  void constrain();
  void resolveDuplicates(PieceFigures& figures);
  PieceInterior writeInterior();
  FinishedPiece writeAlone();

  const PieceWork& Work;
  const PartitionIndex Piece;
  const std::int64_t First; ///< index of the first point among all spilled points
  Buffer<double> Rows;
  PointBuckets<std::int32_t> Buckets;
  std::vector<std::size_t> InteriorCounts; ///< triangles, of each partition

  std::mutex Mutex;                                               ///< for what follows
  std::unordered_map<std::int32_t, std::int32_t> Representatives; ///< of duplicates
  std::vector<std::uint8_t> IsOnInterface;                        ///< of each point
  std::vector<std::array<std::int32_t, 3>>
    BoundaryTriangles; ///< between partitions, but of the interior
  PieceResult Result;
};

/// Makes all pieces of a run whose pieces have no borders: the points are collinear, or there is
/// one piece. `progress` is called with the number of points that are done. Returns the pieces by
/// their numbers in the mesh; an empty list if `progress` ended it. Throws IOError.
std::vector<FinishedPiece> triangulateAlone(const PieceWork& work, bool areCollinear,
  const std::function<bool(std::int64_t)>& progress, PieceFigures& figures);

} // namespace tipp

#endif
