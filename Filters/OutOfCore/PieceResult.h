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

/// What a run's pieces are made of and go to; the same on all ranks.
struct PieceWork
{
  const PiecePlan& Plan;
  const SpilledPoints& Points;
  double Factor; ///< of coordinates
  const PointRowLayout& Rows;
  const PartitionedMesh& Mesh;
  std::string Results;                  ///< how the paths of pieces' results begin
  TriangleConsumer* Consumer = nullptr; ///< null: triangles go to the mesh
  double MaximumEdge = 0;               ///< triangles with a longer edge are left out; 0: none are
  DuplicateRule Duplicates = DuplicateRule::First;
  const PieceSegments* Constraints = nullptr; ///< null: there are none
  std::size_t Elevation = 0; ///< among the columns of rows; their number if there is none

  /// Whether Consumer gets triangles between pieces as soon as these are done: constraints may
  /// change or remove them.
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

/// Triangles (3 corners) or tetrahedra (4) at the border of the piece that owns them, by indices
/// among all spilled points.
template <std::size_t CornerCount>
struct BorderCells
{
  using Cell = std::array<std::int64_t, CornerCount>;

  std::vector<Cell> Corners;
  std::vector<std::int32_t> Borrowers;     ///< numbers of pieces in the mesh, ascending for each
  std::vector<std::uint64_t> BorrowerEnds; ///< of each cell, in Borrowers

  /// `met`: the pieces that the cell meets, ascending; the first is its owner.
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

/// Adds each triangle at the borders of pieces to those of the piece that owns it: of all that the
/// triangle meets, the first in the mesh. The others borrow it. Where there are constraints, which
/// change triangles, too long ones are left out later.
class BorderSorter : public FinalTriangleConsumer
{
public:
  /// Both must outlive this.
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

/// Moves the triangles of `from` to the end of those in `to`.
void append(BordersByOwner&& from, BordersByOwner& to);

/// What a piece whose partitions are all triangulated leaves for others, besides the interior's
/// share of its file in the mesh. It is written once and never changed: the set of these files is
/// the state from which a run is resumed.
///
/// A triangle belongs to the piece's interior if its circumdisk meets no other piece, and else to a
/// border. Own points of a border's triangle, of an unfinished one, or of one with an artificial
/// corner are interface points. They are known: by Lemma 6 the last partition of this piece that an
/// unfinished triangle meets has just sent it, and a triangle that is made later replaces such
/// ones.
struct PieceResult
{
  PieceInterior Interior;
  PieceFigures Figures;
  std::vector<BoundaryVertex> HullVertices; ///< of triangles at artificial points
  BordersByOwner Borders;
  /// Of the interior, what constraints cross that are not complete in it; these triangles are not
  /// in the interior, and their corners are interface points.
  CrossedPart Crossed;
  std::map<PartitionIndex, SentMessages> Sent; ///< by the recipient's piece
};

/// Returns the file's bytes. Throws IOError.
std::uint64_t writeResult(const std::string& path, const PieceResult& result);

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
  CrossedPart readCrossed() const;
  PieceFigures readFigures() const;
  /// The caller must add the indices of the piece's own points.
  PieceInterior readInterior() const;

private:
  SectionFile File;
};

} // namespace tipp

#endif
