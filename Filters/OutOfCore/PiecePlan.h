// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPiecePlan_h
#define tippPiecePlan_h

#include "Engine/PartitionSchedule.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/SpilledPoints.h"
#include "Predicates/Geometry.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/InputSurvey.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// Returns a piece's index in the mesh: pieces are numbered from the last to the first. For a
/// tiling gives a point on a cut to the upper box, which has the higher index, and a mesh gives a
/// point that pieces share to the piece of lowest index. Reversed, both rules choose the same
/// piece.
///
/// Boxes in the order of the mesh would need no reversal. But spilled points would then be in
/// another order, and so would the triangles that are sorted by them: the same input would give
/// other files, and runs of earlier versions could not be resumed.
inline std::size_t numberInMesh(PartitionIndex piece, PartitionIndex pieces)
{
  return static_cast<std::size_t>(pieces - 1 - piece);
}

/// A point of the initial mesh of a run out of core in D dimensions.
template <int D>
struct InitialPointOf
{
  std::int64_t Id; ///< index in the stream
  /// Multiplied by InputSurveyOf::Factor.
  Point<D> Position;
  PartitionIndex Partition;
  std::int32_t Padding = 0;   ///< so that all bytes of a record are defined
  std::int64_t InPieces = -1; ///< index among all spilled points; -1: not known yet
};

using InitialPoint = InitialPointOf<2>;

/// Returns the points of a sample by partition.
template <int D>
std::vector<std::vector<InitialPointOf<D>>> groupByPartition(
  const std::vector<SampledPointOf<Point<D>>>& sample, const CutTree<D>& partitions)
{
  std::vector<std::vector<InitialPointOf<D>>> groups(std::size_t(partitions.size()));
  for (const SampledPointOf<Point<D>>& p : sample)
  {
    const PartitionIndex partition = partitions.locate(p.Position);
    groups[std::size_t(partition)].push_back({ p.Id, p.Position, partition });
  }
  return groups;
}

/// Sorts points by their index in the stream.
template <int D>
void sortById(std::vector<InitialPointOf<D>>& points)
{
  std::sort(points.begin(), points.end(),
    [](const InitialPointOf<D>& a, const InitialPointOf<D>& b) { return a.Id < b.Id; });
}

/// How points are read if memory is limited.
struct VTKTIPPFILTERS_EXPORT InputMemory
{
  /// `limit`: in bytes; `rowWords`: 64-bit words of a spilled row.
  InputMemory(std::uint64_t limit, std::size_t rowWords);

  std::size_t BlockPoints;  ///< points per read
  std::size_t SamplePoints; ///< smallest size of the survey's sample
};

/// How the memory limit is divided among the phases of a run.
struct VTKTIPPFILTERS_EXPORT MemoryPlan : InputMemory
{
  /// `rowWords`: 64-bit words of a spilled row (PointRowLayout::Words).
  MemoryPlan(const OutOfCoreOptions& options, std::size_t rowWords, bool hasConstraints);

  std::int64_t PiecePoints; ///< approximate points per piece
  /// Approximate points per partition.
  std::int64_t PartitionPoints;
  std::uint64_t LoadedBytes; ///< of all pieces in memory together

  /// Returns the bytes of memory that a piece needs while it is triangulated and written, without
  /// kernels.
  static std::uint64_t pieceBytes(std::int64_t points, std::size_t rowWords);
};

/// The two levels of boxes. Pieces are spilled, loaded and written; each consists of partitions,
/// which workers triangulate.
struct VTKTIPPFILTERS_EXPORT PiecePlan
{
  static constexpr int Dimensions = 2;

  PiecePlan(const InputSurvey& survey, const OutOfCoreOptions& options, const MemoryPlan& memory,
    std::size_t rowWords, int threads);
  explicit PiecePlan(LoadArchive& archive);
  void save(SaveArchive& archive) const;

  Tiling Pieces;
  std::vector<Tiling> Inner;                  ///< by piece: its partitions
  Tiling Partitions;                          ///< all partitions
  std::vector<PartitionIndex> FirstPartition; ///< by piece; one more entry at the end
  std::vector<std::int32_t> PieceOf;          ///< by partition
  std::vector<BoundaryVertex> Artificial;
  std::vector<InitialPoint> Initial; ///< ascending ids
  /// There is one piece of one partition, without artificial points: partitioning does not pay for
  /// these points, or doubles cannot enclose them.
  bool IsAlone = false;
  /// Nearly all points may be interface points: partitioning does not pay, but a single piece does
  /// not fit in memory.
  bool HasLargeInterface = false;

  PartitionIndex pieces() const { return this->Pieces.size(); }
  Box2 box(PartitionIndex piece) const { return this->Pieces.box(piece); }

  /// See numberInMesh().
  std::size_t number(PartitionIndex piece) const { return numberInMesh(piece, this->pieces()); }
  PartitionIndex pieceOf(const InitialPoint& p) const
  {
    return this->PieceOf[std::size_t(p.Partition)];
  }

  /// Returns the vertices of the initial mesh. Their ids are valid once the initial points have
  /// InPieces.
  std::vector<BoundaryVertex> initialVertices() const;

private:
  void choosePartitions(const InputSurvey& survey, const MemoryPlan& memory);
  void chooseInitialPoints(const InputSurvey& survey, int pointsPerPartition);
  void numberPartitions();
  void takeAlone(const InputSurvey& survey);
  void takeWholePieces(const InputSurvey& survey);
};

/// The order in which pieces and their partitions are triangulated. It depends only on the plan and
/// on which pieces have points, so every process computes the same order.
///
/// Two pieces conflict if some of their partitions conflict. Pieces are coloured and ordered by
/// colour: pieces of one colour are independent, so that all threads and ranks have work. The
/// partitions of a piece are consecutive in the order.
class VTKTIPPFILTERS_EXPORT PieceOrder
{
public:
  PieceOrder(const PiecePlan& plan, const SpilledPoints& points, int threads);

  /// Returns the pieces that have points, in order.
  const std::vector<PartitionIndex>& sequence() const { return this->Sequence; }
  const PartitionOrder& partitions() const { return this->Partitions; }
  /// Returns the regions of all partitions.
  const Regions& regions() const { return this->Boxes; }
  /// Returns the initial mesh and gives it up: may be called only once.
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
