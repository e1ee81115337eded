// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPiecePlan3_h
#define tippPiecePlan3_h

#include "OutOfCore/PiecePlan.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/InputSurvey.h"
#include "Triangulation3D/Partitions3.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// How the memory limit is divided among the phases of a run in space.
struct VTKTIPPFILTERS_EXPORT MemoryPlan3 : InputMemory
{
  /// `limit`: in bytes. `piecePoints`: the approximate number of points per piece, or 0: as memory
  /// allows. `words`: 64-bit words of a point's row.
  MemoryPlan3(std::uint64_t limit, std::int64_t piecePoints, std::size_t words);

  std::int64_t PiecePoints; ///< approximate points per piece
  std::uint64_t PieceBytes; ///< of all pieces that are triangulated at the same time

  /// Returns the bytes of memory that a piece needs while it is triangulated. `points`: its points;
  /// `others`: vertices of other pieces; `words`: as above.
  static std::uint64_t bytesOf(std::int64_t points, std::int64_t others, std::size_t words);
};

/// The bounding box of a piece's points, and on each of its sides the first point there.
struct ExtremePoints
{
  Box3 Region = Box3::empty();
  /// Indices among the piece's points, by side; all 0 if there are none.
  std::array<std::int64_t, 6> Indices = {};
  std::array<Point3, 6> Positions = {};

  void add(std::int64_t index, const Point3& p);
  /// Adds the points of a later part of the stream. `before`: the number of points so far.
  void add(const ExtremePoints& part, std::int64_t before);
};

/// The pieces of a triangulation in space out of core. Each piece is one partition, which is
/// spilled, loaded, triangulated and written as a whole.
struct VTKTIPPFILTERS_EXPORT PiecePlan3
{
  static constexpr int Dimensions = 3;

  /// Divides space into pieces. `words`: 64-bit words of a point's row. Throws IOError if the
  /// points have no tetrahedra because all are in one plane.
  PiecePlan3(const InputSurvey3& survey, const MemoryPlan3& memory, std::size_t words);
  /// Restores a saved plan. Throws std::runtime_error if it is damaged.
  explicit PiecePlan3(LoadArchive& archive);
  void save(SaveArchive& archive) const;

  Tiling3 Pieces{ {}, 1 };
  std::vector<Box3> Boxes; ///< by piece; together they fill the bounds
  /// Sampled points; ascending ids. The initial mesh has Extremes, too.
  std::vector<InitialPointOf<3>> Initial;
  /// @name Known once the points are spilled
  ///@{
  /// By piece, see placeInitialPoints(). Later their Indices are among all spilled points.
  std::vector<ExtremePoints> Extremes;
  std::vector<Box3> Regions; ///< bounding boxes of the pieces' points
  std::vector<Vertex3> Artificial;
  ///@}

  PartitionIndex pieces() const { return this->Pieces.size(); }
  const Box3& box(PartitionIndex piece) const { return this->Boxes[std::size_t(piece)]; }

  /// See numberInMesh().
  std::size_t number(PartitionIndex piece) const { return numberInMesh(piece, this->pieces()); }
  static PartitionIndex pieceOf(const InitialPointOf<3>& p) { return p.Partition; }

  /// Completes the plan once the points are spilled: sets Regions and the artificial points around
  /// them. `starts` has the index of each piece's first point, which is added to the indices in
  /// Extremes. Throws IOError if doubles cannot enclose the regions.
  void encloseExtremes(const std::vector<std::int64_t>& starts);

  /// Returns the initial mesh, whose ids are indices among all spilled points. Call it once the
  /// points are spilled.
  BoundaryCells<3> initialMesh() const;

private:
  void chooseInitialPoints(const InputSurvey3& survey);
  void enclose();
  PointBuckets3 initialBuckets(std::vector<std::int64_t>& indices) const;
};

} // namespace tipp

#endif
