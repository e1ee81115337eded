// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceResult_h
#define tippPieceResult_h

#include "Duplicates/ResolveDuplicates.h"
#include "Engine/Routing.h"
#include "OutOfCore/PieceFigures.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SectionFile.h"
#include "OutOfCore/SpillPoints.h"
#include "OutOfCore/TriangleTaker.h"
#include "Partitioned/GrowingPiece.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
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
  std::string Results;            ///< how the paths of pieces' results begin
  TriangleTaker* Taker = nullptr; ///< null: triangles go to the mesh
  double MaximumEdge = 0;         ///< triangles with a longer edge are left out; 0: none are
  DuplicateRule Duplicates = DuplicateRule::First;
  std::size_t Elevation = 0; ///< among the columns of rows; their number if there is none

  std::string resultPath(PartitionIndex piece) const
  {
    return this->Results + "." + std::to_string(this->Plan.number(piece));
  }
  std::string finishedPath(PartitionIndex piece) const
  {
    return this->resultPath(piece) + ".finished";
  }
};

/// Triangles at the border of the piece that owns them, by indices among all spilled
/// points.
struct BorderTriangles
{
  std::vector<std::array<std::int64_t, 3>> Corners;
  std::vector<std::int32_t> Borrowers;     ///< numbers of pieces in the mesh, ascending for each
  std::vector<std::uint64_t> BorrowerEnds; ///< of each triangle, in Borrowers
};

/// Messages to partitions, with their recipients.

/// What a piece whose partitions are all triangulated leaves for others, besides the interior's
/// share of its file in the mesh. It is written once and not changed any more: which of these files
/// are there is the state that a run goes on from.
///
/// A triangle is of the piece's interior if its circumdisk meets no other piece, and else of a
/// border. Own points with a triangle of the latter kind, or with one that is not final or at an
/// artificial point, are on the rim. They are known: by Lemma 6 the last partition of this piece
/// that an unfinished triangle meets has just sent it, and a triangle that is made later replaces
/// such ones.
struct PieceResult
{
  GrowingPiece Interior;
  PieceFigures Figures;
  std::vector<BoundaryVertex> HullVertices;          ///< of triangles at artificial points
  std::map<PartitionIndex, BorderTriangles> Borders; ///< by the piece that owns them
  std::map<PartitionIndex, SentMessages> Sent;       ///< by the recipient's piece
};

/// Returns the file's bytes. Throws IOError.
std::uint64_t writeResult(const std::string& path, PieceResult& result);

/// A result on disk, read by parts. Throws IOError for what is damaged or missing.
class VTKTIPPFILTERS_EXPORT StoredResult
{
public:
  explicit StoredResult(const std::string& path)
    : File(path)
  {
  }

  void verify() const { this->File.verify(); }

  bool hasMessages(PartitionIndex to) const;
  SentMessages readMessages(PartitionIndex to) const;
  bool hasBorder(PartitionIndex owner) const;
  BorderTriangles readBorder(PartitionIndex owner) const;
  std::vector<BoundaryVertex> readHullVertices() const;
  PieceFigures readFigures() const;
  /// `interior`: the piece, with nothing in it yet.
  void readInterior(GrowingPiece& interior) const;

private:
  SectionFile File;
};

} // namespace tipp

#endif
