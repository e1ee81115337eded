// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLoadedPiece_h
#define tippLoadedPiece_h

#include "OutOfCore/LoadedSegments.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "Partitioned/FinishedPieces.h"
#include "Triangulation/Dataflow.h"

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
/// until they are written. Points are identified by their index in the piece, except in messages
/// and results, where it is their index among all spilled points.
class VTKTIPPFILTERS_EXPORT LoadedPiece
{
public:
  /// Reads the points of the piece. `work` must outlive this object. Throws IOError.
  LoadedPiece(const PieceWork& work, PartitionIndex piece);

  /// Returns the bytes of memory that a piece needs.
  static std::uint64_t bytesOf(const PieceWork& work, PartitionIndex piece);

  /// The memory of one thread, which is reused from partition to partition.
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
    }

    const PieceOrder& Order;
    PartitionIndex Piece = NoPartition;
    std::unique_ptr<Worker<std::int32_t>> Triangulator; ///< a worker for Piece
    std::unique_ptr<Routing<std::int32_t>> Router;
  };

  /// Triangulates a partition's points and the vertices in its inbox. Returns the messages to later
  /// partitions. Threads may call it at the same time, each with its own `space`.
  SentMessages triangulate(
    Workspace& space, PartitionIndex partition, const std::vector<VertexMessage>& inbox);

  std::int64_t pointsOf(PartitionIndex partition) const
  {
    return std::int64_t(
      this->Buckets.count(partition - this->Work.Plan.FirstPartition[std::size_t(this->Piece)]));
  }

  /// Call this when all partitions are triangulated. Writes the interior's part of the piece's file
  /// in the mesh, frees the points, and returns the remaining results. Throws IOError.
  PieceResult write();

  /// @name A piece without a border
  /// These methods write the complete file of the piece. They throw IOError.
  ///@{
  /// For points on one line: there are no triangles.
  FinishedPiece writePointsAlone(PieceFigures& figures);
  /// For a single piece with one partition and no artificial points. Returns false if `progress`
  /// stopped the run.
  bool triangulateAlone(
    const DelaunayKernel::Monitor& progress, PieceFigures& figures, FinishedPiece& finished);
  ///@}

private:
  struct FinalTriangleSorter;

  PointsView points() const;
  void prepare(Workspace& space);
  void take(FinalTriangleSorter& sorter, const SentMessages& sent);
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
  std::unique_ptr<LoadedSegments> Constraints; ///< null: no constraint is near
  PointBuckets<std::int32_t> Buckets;
  std::vector<std::size_t> InteriorCounts; ///< by partition: its number of triangles

  std::mutex Mutex;                                               ///< protects the members below
  std::unordered_map<std::int32_t, std::int32_t> Representatives; ///< by duplicate
  std::vector<std::uint8_t> IsOnInterface; ///< by point: 1 if other pieces need it
  /// Interior triangles between partitions.
  std::vector<std::array<std::int32_t, 3>> BoundaryTriangles;
  PieceResult Result;
};

/// Makes all pieces of a run without borders: the points are collinear, or there is only one piece.
/// `progress` is called with the number of finished points. Returns the pieces in the order of the
/// mesh; an empty list if `progress` stopped the run. Throws IOError.
std::vector<FinishedPiece> triangulateAlone(const PieceWork& work, bool areCollinear,
  const std::function<bool(std::int64_t)>& progress, PieceFigures& figures);

} // namespace tipp

#endif
