// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceSchedule_h
#define tippPieceSchedule_h

#include "Distributed/GroupMesh.h"
#include "OutOfCore/AsideFile.h"
#include "OutOfCore/Checkpoint.h"
#include "OutOfCore/HullVertices.h"
#include "OutOfCore/LoadedPieces.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SpillPoints.h"
#include "Partitioned/GrowingPiece.h"
#include "Triangulation/IndependentPartitions.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The state of all pieces between the workers of all ranks: which partitions may be active, what
/// is final, which piece it belongs to. Not thread-safe.
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

  /// Goes on where another one was when it was saved. Pieces that were loaded then are to be loaded
  /// again.
  PieceSchedule(const PiecePlan& plan, const SpilledPoints& points, const PointRowLayout& rows,
    LoadArchive& archive);
  /// What is active counts as not begun. Interiors and borders that are being written count as not
  /// written.
  void save(SaveArchive& archive);

  /// Complete borders that wait for the hull alone go to this file where all take more than so many
  /// bytes; others where all take more than five times as many.
  void putAside(AsideFile& file, std::uint64_t most)
  {
    this->Aside = &file;
    this->MostBorderBytes = most;
  }

  /// The rim's vertices go to this file where they take more than so many bytes.
  void spillRim(VertexFile& file, std::uint64_t most) { this->Rim.spillTo(file, most); }

  /// Whether a piece has yet to be loaded.
  bool isToLoad(PartitionIndex piece) const
  {
    return this->Pieces[std::size_t(piece)].At == Stage::Waiting && this->Points.count(piece) > 0;
  }
  /// Whether its interior is written but its border is not.
  bool hasInterior(PartitionIndex piece) const
  {
    return this->Pieces[std::size_t(piece)].At == Stage::Interior;
  }
  /// Whether all of it is written.
  bool isDone(PartitionIndex piece) const
  {
    return this->Pieces[std::size_t(piece)].At == Stage::Done;
  }
  bool isFinished(PartitionIndex partition) const { return this->Rim.isFinished(partition); }
  /// Those of the piece's partitions that are.
  std::vector<PartitionIndex> finishedPartitions(PartitionIndex piece) const;

  PartitionIndex pieces() const { return this->Plan.pieces(); }

  /// From now on this rank may have the piece's partitions. True if all of them are finished
  /// already.
  bool addLoaded(PartitionIndex piece, int rank = 0);
  int rankOf(PartitionIndex piece) const { return this->Pieces[std::size_t(piece)].Rank; }

  /// A partition of a piece loaded by the rank that is independent of all active ones, and the
  /// vertices of the triangles that belong to it; -1 if there is none now.
  PartitionIndex activateNext(std::vector<PlainVertex>& vertices, int rank = 0);

  /// True if this was the piece's last partition: then its interior is to be written.
  bool complete(PartitionResult result);

  /// Before and after a piece's interior is written.
  InteriorTask startInterior(PartitionIndex piece);
  void finishInterior(PartitionIndex piece, GrowingPiece interior);

  /// A piece whose border is complete now, or -1. It is handed out once, and not changed any more.
  PartitionIndex takeComplete();
  const GrowingPiece& growing(PartitionIndex piece) const
  {
    return this->Pieces[std::size_t(piece)].Growing;
  }
  /// The same, with all of its border, wherever this is. May be called for one that was handed out
  /// while the others change.
  GrowingPiece border(PartitionIndex piece) const;
  /// The border has been written; frees it.
  void finishBorder(PartitionIndex piece);

  bool allActivated() const { return this->Waiting.isEmpty(); }
  /// Whether the interiors of all pieces are written.
  bool allInterior() const;
  /// When they are: replaces the artificial points' triangles.
  void repairHull();

  std::size_t rimTriangles() const { return this->Rim.size(); }
  std::uint64_t rimBytes() const { return this->Rim.vertexBytes(); }
  std::uint64_t borderBytes() const;

private:
  PieceSchedule(const PiecePlan& plan, const SpilledPoints& points, const PointRowLayout& rows,
    const std::vector<PartitionIndex>& unfinished);
  template <typename Archive>
  void exchangePiece(Archive& archive, PartitionIndex piece);
  template <typename Archive>
  void exchangeRim(Archive& archive, PartitionIndex piece);
  static std::vector<std::int32_t> placesOfRim(const std::vector<std::uint8_t>& rim);

  enum class Stage
  {
    Waiting,
    Loaded,
    Writing, ///< its interior
    Interior,
    Taken, ///< its border is being written
    Done
  };
  /// A row of this piece that another piece's border wants as soon as it is known.
  struct WantedRow
  {
    PartitionIndex By;
    std::int64_t Place;
  };
  struct State
  {
    Stage At = Stage::Waiting;
    int Rank = 0; ///< which has loaded it
    PartitionIndex PartitionsLeft = 0;
    bool WaitsForHull = false;
    std::uint64_t RowsMissing = 0; ///< of other pieces' points, at the border
    // Until the interior is written:
    std::vector<std::uint8_t> Rim; ///< of each point, once one of them is on the rim
    std::vector<std::array<std::int32_t, 3>> Seams; ///< triangles that meet no other piece
    std::vector<WantedRow> Wanted;
    GrowingPiece Growing; ///< but for what is aside
    AsideFile::Part Aside;
  };

  void takeFinal(const GroupMesh::Final& final);
  void takeInterior(PartitionIndex piece, const SeamGroups& groups, std::uint32_t group);
  void takeBorder(const SeamGroups& groups, std::uint32_t group);
  void share(const std::array<PlainVertex, 3>& triangle);
  void markRim(const PlainVertex& v);
  void markLive(PartitionIndex piece);
  PartitionIndex pieceOf(std::int64_t place) const;
  void wantRow(PartitionIndex by, std::int64_t place);
  void takeRowsFromAside();
  bool isMet(PartitionIndex piece) const;
  void putAsideGrowing();
  void writeAside(State& state);
  /// The pieces that the triangle meets, by their numbers in the mesh, ascending.
  void findMet(const std::array<PlainVertex, 3>& triangle, std::vector<std::int32_t>& met) const;

  const PiecePlan& Plan;
  const SpilledPoints& Points;
  const PointRowLayout& Rows;
  GroupMesh Rim;
  IndependentPartitions Waiting;
  std::vector<State> Pieces;
  std::vector<PartitionIndex> Window; ///< loaded pieces
  HullVertices Hull;
  std::vector<std::int32_t> Met;
  bool HullRepaired = false;
  AsideFile* Aside = nullptr;
  std::uint64_t MostBorderBytes = 0;
  std::vector<WantedRow> WantedFromAside;
};

} // namespace tipp

#endif
