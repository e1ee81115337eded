// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPiecePlan3_h
#define tippPiecePlan3_h

#include "Engine/PartitionOrder.h"
#include "OutOfCore/StreamSampler.h"
#include "Partitioned/PieceBorder.h"
#include "Partitioning/Spill.h"
#include "Points/PointStream.h"
#include "Triangulation3D/InitialMesh3.h"
#include "Triangulation3D/Tiling3.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// How the memory limit is divided.
struct VTKTIPPFILTERS_EXPORT MemoryPlan3
{
  /// `limit` in bytes; `piecePoints`: the approximate number of points of a piece, 0: as memory
  /// allows; `words`: of a point's row.
  MemoryPlan3(std::uint64_t limit, std::int64_t piecePoints, std::size_t words);

  std::size_t BlockPoints;  ///< read at a time
  std::size_t SamplePoints; ///< at least, of the survey
  std::int64_t PiecePoints; ///< of a piece, approximately
  std::uint64_t PieceBytes; ///< of pieces that are triangulated at the same time

  /// Bytes of a piece of `points` points while it is triangulated, with `others` vertices of other
  /// pieces.
  static std::uint64_t bytesOf(std::int64_t points, std::int64_t others, std::size_t words);
};

/// The result of the first pass over points in space.
struct InputSurvey3
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0; ///< NaN or infinite coordinates
  std::int64_t LeftOut = 0;  ///< by the options of the input
  std::int64_t ThinnedOut = 0;
  Box3 Bounds;        ///< of the finite points, times Factor
  double Factor = 1;  ///< a power of two that brings coordinates near 1, where they are far from it
  int Dimension = -1; ///< of the finite points: see Tetrahedralization
  std::size_t Elevation = 0; ///< which column is the third coordinate

  std::int64_t finite() const { return this->Points - this->Rejected; }
};

/// What is known of a piece when its points are spilled.
struct SpilledPiece3
{
  std::int64_t Count = 0;
  PointBounds Region;                       ///< the bounding box of its points
  std::array<std::int64_t, 6> Extreme = {}; ///< indices of points at the region's sides
  std::array<Point3, 6> ExtremePositions = {};
};

/// A point of the initial mesh: its index among all spilled points, and where it is.
struct InitialPoint3
{
  std::int64_t Index;
  Point3 Position;
};

/// The pieces of a triangulation in space out of core. A piece is a partition: it is spilled,
/// loaded, triangulated and written at once.
///
/// Points are surveyed in one pass (one more where coordinates may have to be scaled) and spilled
/// in another one. Results do not depend on the number of threads.
class VTKTIPPFILTERS_EXPORT PiecePlan3
{
public:
  using Progress = std::function<void(std::int64_t)>; ///< of points done; it throws to end the run

  /// The first pass. Throws IOError, also if there is no finite point or they are coplanar.
  PiecePlan3(PointStream& points, const MemoryPlan3& memory, const Progress& progress);

  /// Divides space. Throws IOError if coordinates reach too far.
  void divide(const MemoryPlan3& memory, std::size_t words);

  /// The second pass: spills rows of points by piece to `file`.
  void spill(PointStream& points, const PointRowLayout& rows, const std::string& file,
    const MemoryPlan3& memory, int threads, const Progress& progress);

  const InputSurvey3& survey() const { return this->Survey; }
  PartitionIndex pieces() const { return this->Tiling.size(); }
  const Tiling3& tiling() const { return this->Tiling; }
  const std::vector<Box3>& boxes() const { return this->Boxes; }     ///< which fill the bounds
  const std::vector<Box3>& regions() const { return this->Regions; } ///< of their points
  const std::vector<Vertex3>& artificial() const { return this->Artificial; }

  /// The piece's index in the mesh, where the order is the opposite: a point on a cut belongs to
  /// the upper box here and to the first piece there.
  std::size_t number(PartitionIndex piece) const { return std::size_t(this->pieces() - 1 - piece); }

  std::int64_t first(PartitionIndex piece) const { return this->Starts[std::size_t(piece)]; }
  std::int64_t count(PartitionIndex piece) const
  {
    return this->Starts[std::size_t(piece) + 1] - this->first(piece);
  }
  PartitionIndex pieceOf(std::int64_t index) const;
  void read(PartitionIndex piece, double* rows) const
  {
    this->Rows->readAll(std::size_t(piece), rows);
  }
  std::uint64_t spilledBytes() const { return this->Rows->bytes(); }

  /// After spill().
  InitialMesh3 initialMesh() const;

private:
  struct Labels;
  using Sampled = SampledPointOf<Point3>;

  void findFactor(PointStream& points, std::size_t blockPoints, double largest);
  bool samplePays() const;
  void chooseInitialPoints();
  PointBuckets3 initialBuckets() const;

  InputSurvey3 Survey;
  std::vector<Sampled> Sample; ///< by id; until spill() one of few for each piece
  Tiling3 Tiling{ {}, 1 };
  std::vector<Box3> Boxes;
  std::vector<Box3> Regions;
  std::vector<Vertex3> Artificial;
  std::vector<std::vector<InitialPoint3>> Initial; ///< of each piece
  std::vector<std::int64_t> Starts; ///< index of each piece's first point; and one past the last
  std::unique_ptr<Spill> Rows;
};

} // namespace tipp

#endif
