// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceResult_h
#define tippPieceResult_h

#include "Constraints/CrossedPart.h"
#include "Duplicates/ResolveDuplicates.h"
#include "Engine/Routing.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceSegments.h"
#include "OutOfCore/ScratchFiles.h"
#include "Partitioned/PieceBorder.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// The input and the destination of the work on a run's pieces. It is the same on all ranks.
/// References and pointers are not owned.
struct PieceWork
{
  const PiecePlan& Plan;
  const SpilledPoints& Points;
  double Factor; ///< multiplies the points' coordinates to give the plan's
  const PointRowLayout& Rows;
  const PartitionedMesh& Mesh;
  std::string Results;                  ///< prefix of the paths of results
  TriangleConsumer* Consumer = nullptr; ///< null: triangles are written to the mesh
  double MaximumEdge = 0; ///< triangles with a longer edge are left out; 0: all are kept
  DuplicateRule Duplicates = DuplicateRule::First;
  const PieceSegments* Constraints = nullptr; ///< null: no constraints
  /// Its index among the columns; the number of columns if there is none.
  std::size_t Elevation = 0;

  /// Returns whether Consumer gets the triangles between pieces as soon as these pieces are done.
  /// With constraints it does not, because they may change or remove these triangles.
  bool takesBordersEarly() const { return this->Consumer && !this->Constraints; }

  std::string resultPath(PartitionIndex piece) const
  {
    return this->Results + "." + std::to_string(this->Plan.number(piece));
  }
  std::string finishedPath(PartitionIndex piece) const
  {
    return this->resultPath(piece) + ".finished";
  }
};

/// Triangles (3 corners) or tetrahedra (4 corners) at the border of the piece that owns them.
/// Corners are indices among all spilled points.
template <std::size_t CornerCount>
struct BorderCells
{
  using Cell = std::array<std::int64_t, CornerCount>;

  std::vector<Cell> Corners;
  std::vector<std::int32_t> Borrowers;     ///< ascending per cell; pieces are indices in the mesh
  std::vector<std::uint64_t> BorrowerEnds; ///< by cell: the end of its entries in Borrowers

  /// `met`: the pieces that the cell meets, as indices in the mesh, ascending. The first owns the
  /// cell.
  void add(const Cell& cell, const std::vector<std::int32_t>& met)
  {
    this->Corners.push_back(cell);
    this->Borrowers.insert(this->Borrowers.end(), met.begin() + 1, met.end());
    this->BorrowerEnds.push_back(this->Borrowers.size());
  }
};

using BorderTriangles = BorderCells<3>;

template <typename Archive, std::size_t CornerCount>
void serialize(Archive& archive, BorderCells<CornerCount>& border)
{
  archive(border.Corners, border.Borrowers, border.BorrowerEnds);
}

using BordersByOwner = std::map<PartitionIndex, BorderTriangles>;

/// Adds each border triangle to those of the piece that owns it: the first in the mesh of the
/// pieces that it meets. The others borrow it. Triangles that are too long are left out, but with
/// constraints, which change triangles, that happens later.
class BorderSorter : public FinalTriangleConsumer
{
public:
  /// Both arguments must outlive this object.
  BorderSorter(const PieceWork& work, BordersByOwner& borders)
    : Work(work)
    , Borders(borders)
  {
  }

  void add(const BoundaryTriangle& triangle) override;

private:
  void findMet(const BoundaryTriangle& triangle);

  const PieceWork& Work;
  BordersByOwner& Borders;
  std::vector<std::int32_t> Met;
};

/// Appends the triangles of `from` to those of `to`.
void append(BordersByOwner&& from, BordersByOwner& to);

/// The result of a piece whose partitions are all triangulated: the data that others need, besides
/// the interior's part of the mesh file. It is written once and never changed; the set of these
/// files is the state from which a run is resumed.
///
/// A triangle belongs to the piece's interior if its circumdisk meets no other piece, and otherwise
/// to a border. A piece's points are interface points if they are corners of border triangles, of
/// triangles that are not final, or of triangles with an artificial corner. All of them are known
/// when the piece is done: by Lemma 6, the last partition of the piece that a triangle meets has
/// sent the triangle if it is not final, and triangles that are made later replace triangles like
/// these.
struct PieceResult
{
  PieceInterior Interior;
  PieceFigures Figures;
  std::vector<BoundaryVertex> HullVertices; ///< true corners of triangles with artificial corners
  BordersByOwner Borders;
  /// The interior triangles that are crossed by constraints not complete in the interior. They are
  /// left out of the interior, and their corners are interface points.
  CrossedPart Crossed;
  std::map<PartitionIndex, SentMessages> Sent; ///< by the recipient's piece
};

/// Writes a result to a file. Returns the size of the file in bytes. Throws IOError.
std::uint64_t writeResult(const std::string& path, const PieceResult& result);

/// Reads parts of a result from its file. All methods except has...() throw IOError if the file is
/// damaged or missing.
class VTKTIPPFILTERS_EXPORT StoredResult
{
public:
  explicit StoredResult(const std::string& path)
    : File(path)
  {
  }

  void verify() const { this->File.verify(); }

  /// `to`: the piece that receives the messages.
  bool hasMessages(PartitionIndex to) const;
  SentMessages readMessages(PartitionIndex to) const;
  /// `owner`: the piece that owns the triangles.
  bool hasBorder(PartitionIndex owner) const;
  BorderTriangles readBorder(PartitionIndex owner) const;
  std::vector<BoundaryVertex> readHullVertices() const;
  CrossedPart readCrossed() const;
  PieceFigures readFigures() const;
  /// Returns the interior without First and OwnPoints; see readInterior() in FinishPieces.h.
  PieceInterior readInterior() const;

private:
  SectionFile File;
};

} // namespace tipp

#endif
