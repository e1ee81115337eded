// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPiecePlan_h
#define tippPiecePlan_h

#include "Engine/PartitionOrder.h"
#include "OutOfCore/InputSurvey.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

class SaveArchive;
class LoadArchive;
class SpilledPoints;

/// How the memory limit is divided.
struct VTKTIPPFILTERS_EXPORT MemoryPlan
{
  MemoryPlan(const OutOfCoreOptions& options, std::size_t rowWords);

  std::size_t BlockPoints;  ///< read at a time
  std::size_t SamplePoints; ///< at least, of the survey
  std::int64_t PiecePoints; ///< about
  std::int64_t PartitionPoints;
  std::uint64_t LoadedBytes; ///< of pieces in memory together

  /// Bytes of a piece while its points are triangulated and written, without the kernels.
  static std::uint64_t pieceBytes(std::int64_t points, std::size_t rowWords);
};

/// A point of the initial mesh.
struct InitialPoint
{
  std::int64_t Id; ///< in the stream
  Point2 Position;
  PartitionIndex Partition;
  std::int64_t InPieces = -1; ///< its index when all points are in the order of pieces
};

/// The two levels of boxes: pieces, which are spilled, loaded and written, and in each the
/// partitions that workers triangulate.
struct VTKTIPPFILTERS_EXPORT PiecePlan
{
  PiecePlan(const InputSurvey& survey, const OutOfCoreOptions& options, const MemoryPlan& memory,
    std::size_t rowWords, int threads);
  explicit PiecePlan(LoadArchive& archive);
  void save(SaveArchive& archive) const;

  Tiling Pieces;
  std::vector<Tiling> Inner;                  ///< of each piece
  Tiling Partitions;                          ///< all together
  std::vector<PartitionIndex> FirstPartition; ///< of each piece; one more at the end
  std::vector<std::int32_t> PieceOf;          ///< of each partition
  std::vector<BoundaryVertex> Artificial;
  std::vector<InitialPoint> Initial; ///< by id
  /// One piece of one partition, no artificial points: partitions do not pay for such points, or
  /// doubles cannot enclose them.
  bool IsAlone = false;
  /// Nearly all points may be interface points: partitions do not pay, but there is no memory for a
  /// single one.
  bool HasLargeInterface = false;

  PartitionIndex pieces() const { return this->Pieces.size(); }

  /// The piece's index in the mesh, where the order is the opposite: a point on a cut belongs to
  /// the upper box here and to the first piece there.
  std::size_t number(PartitionIndex piece) const
  {
    return static_cast<std::size_t>(this->pieces() - 1 - piece);
  }

  /// The vertices of the initial mesh, once the initial points have their indices.
  std::vector<BoundaryVertex> initialVertices() const;

private:
  void choosePartitions(const InputSurvey& survey, const MemoryPlan& memory);
  void chooseInitialPoints(const InputSurvey& survey);
  void numberPartitions();
  void takeAlone(const InputSurvey& survey);
  void takeWholePieces(const InputSurvey& survey);
};

/// The order in which pieces, and their partitions, are triangulated. It depends only on the plan
/// and on which pieces have points, so every process computes the same order.
///
/// Two pieces conflict if partitions of theirs do. Pieces are coloured and ordered by colour: those
/// of one colour are independent, so that all threads and ranks have work. A piece is a window of
/// the order of partitions.
class VTKTIPPFILTERS_EXPORT PieceOrder
{
public:
  PieceOrder(const PiecePlan& plan, const SpilledPoints& points, int threads);

  /// Pieces with points, in order.
  const std::vector<PartitionIndex>& sequence() const { return this->Sequence; }
  const PartitionOrder& partitions() const { return this->Partitions; }
  /// Of all partitions.
  const Regions& regions() const { return this->Boxes; }
  /// May be called once.
  BoundaryTriangles takeInitialMesh() { return std::move(this->InitialMesh); }

private:
  void orderPieces(const PiecePlan& plan);

  Regions Boxes;
  BoundaryTriangles InitialMesh;
  PartitionOrder Partitions;
  std::vector<PartitionIndex> Sequence;
};

} // namespace tipp

#endif
