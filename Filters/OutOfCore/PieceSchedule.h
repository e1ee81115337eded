// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceSchedule_h
#define tippPieceSchedule_h

#include "Distributed/GroupMesh.h"
#include "OutOfCore/Checkpoint.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SpillPoints.h"
#include "Partitioned/GrowingPiece.h"
#include "Triangulation/Buffer.h"
#include "Triangulation/IndependentPartitions.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Triangulate.h"

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// A piece's points and triangles while its partitions are worked on.
struct LoadedPiece
{
  Buffer<double> Rows;
  PointBuckets<std::int32_t> Buckets;
  std::vector<std::size_t> InteriorCounts;        ///< triangles, of each partition
  std::vector<std::uint8_t> Rim;                  ///< of each point
  std::vector<std::array<std::int32_t, 3>> Seams; ///< triangles that meet no other piece
  std::unordered_map<std::int32_t, std::int32_t> Representatives;
  PartitionIndex PartitionsLeft = 0;
};

/// What a worker has made of a partition.
struct PartitionResult
{
  PartitionIndex Partition = 0;
  SeamGroups Seams;
  std::size_t InteriorCount = 0;
  std::vector<Duplicate> Duplicates; ///< the representative is the lower one
  std::size_t Vertices = 0;
};

/// The state of all pieces between the workers: which partitions may be active, what is final,
/// which piece it belongs to. Not thread-safe, but for what is said to be.
///
/// A triangle whose circumdisk meets partitions of one piece only is of the piece's interior; the
/// others are the border's. A point with a triangle of the latter kind, or at an artificial point,
/// is on the rim. When all partitions of a piece are finished, its rim is known: a triangle at a
/// point that is changed afterwards meets another piece before and after.
class VTKTIPPFILTERS_EXPORT PieceSchedule
{
public:
  PieceSchedule(const PiecePlan& plan, const SpilledPoints& points, const PointRowLayout& rows,
    const SeamTriangles& initialMesh);

  /// Goes on where another one was when it was saved. Pieces that were loaded then must be loaded
  /// again, with the triangles of their finished partitions, before any partition is activated.
  PieceSchedule(const PiecePlan& plan, const SpilledPoints& points, const PointRowLayout& rows,
    LoadArchive& archive);
  /// What is active counts as not begun. Interiors and borders that are being written count as not
  /// written.
  void save(SaveArchive& archive);

  /// Whether a piece has yet to be loaded, and whether it was when the state was saved.
  bool isToLoad(PartitionIndex piece) const
  {
    const State& state = this->Pieces[std::size_t(piece)];
    return state.At == Stage::Waiting && this->Points.count(piece) > 0;
  }
  bool wasLoaded(PartitionIndex piece) const { return this->Pieces[std::size_t(piece)].WasLoaded; }
  bool isFinished(PartitionIndex partition) const { return this->Rim.isFinished(partition); }

  PartitionIndex pieces() const { return this->Plan.pieces(); }

  /// From now on the piece's partitions may be active. True if all of them are finished already.
  bool addLoaded(PartitionIndex piece, std::unique_ptr<LoadedPiece> loaded);
  LoadedPiece& loaded(PartitionIndex piece) { return *this->Pieces[std::size_t(piece)].Loaded; }

  /// A partition of a loaded piece that is independent of all active ones, and the vertices of the
  /// triangles that belong to it; -1 if there is none now.
  PartitionIndex activateNext(std::vector<PlainVertex>& vertices);

  /// True if this was the piece's last partition: then its interior is to be written.
  bool complete(PartitionResult result);

  /// Before and after a piece's interior is written. In between it may be read by other threads.
  void findRim(PartitionIndex piece);
  GrowingPiece& growing(PartitionIndex piece) { return this->Pieces[std::size_t(piece)].Growing; }
  void finishInterior(PartitionIndex piece);

  /// A piece whose border is complete now, or -1. It is handed out once.
  PartitionIndex takeComplete();
  /// The border has been written; frees it.
  void finishBorder(PartitionIndex piece);

  bool allActivated() const { return this->Waiting.isEmpty(); }
  /// When all partitions are finished: replaces the artificial points' triangles.
  void repairHull();

  std::size_t rimTriangles() const { return this->Rim.size(); }
  std::uint64_t borderBytes();

private:
  PieceSchedule(const PiecePlan& plan, const SpilledPoints& points, const PointRowLayout& rows,
    const std::vector<PartitionIndex>& unfinished);
  template <typename Archive>
  void exchangePiece(Archive& archive, PartitionIndex piece);

  enum class Stage
  {
    Waiting,
    Loaded, ///< or being written
    Interior,
    Taken, ///< its border is being written
    Done
  };
  struct State
  {
    Stage At = Stage::Waiting;
    bool WasLoaded = false; ///< when the state was saved, with these:
    std::vector<std::array<std::int32_t, 3>> SavedSeams;
    std::vector<std::int32_t> SavedRim;
    bool WaitsForHull = false;
    bool IsWritten = false;        ///< by a thread, just now
    std::uint64_t BorderBytes = 0; ///< of Growing when last seen not being written
    std::unique_ptr<LoadedPiece> Loaded;
    GrowingPiece Growing;
  };

  void takeFinal(const GroupMesh::Final& final);
  void takeInterior(PartitionIndex piece, const SeamGroups& groups, std::uint32_t group);
  void takeBorder(const SeamGroups& groups, std::uint32_t group);
  void share(const std::array<PlainVertex, 3>& triangle);
  void markRim(const PlainVertex& v);
  PartitionIndex pieceOf(std::int64_t place) const;
  const double* rowOf(std::int64_t place) const;
  /// The pieces that the triangle meets, by their numbers in the mesh, ascending.
  void findMet(const std::array<PlainVertex, 3>& triangle, std::vector<std::int32_t>& met) const;

  const PiecePlan& Plan;
  const SpilledPoints& Points;
  const PointRowLayout& Rows;
  GroupMesh Rim;
  IndependentPartitions Waiting;
  std::vector<State> Pieces;
  std::vector<PartitionIndex> Window; ///< loaded pieces
  std::vector<SeamTriangle> Hull;     ///< at artificial points
  std::vector<std::int32_t> Met;
  bool HullRepaired = false;
};

} // namespace tipp

#endif
