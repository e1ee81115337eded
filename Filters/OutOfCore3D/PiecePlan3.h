// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPiecePlan3_h
#define tippPiecePlan3_h

#include "Engine/PartitionSchedule.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SpilledPoints.h"
#include "Points/ReadPoints.h"
#include "Triangulation/StreamSampler.h"
#include "Triangulation3D/Partitions3.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// How the memory limit is divided among the phases of a run.
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

/// The result of the first pass over points in space.
struct InputSurvey3
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;   ///< points with NaN or infinite coordinates
  std::int64_t LeftOut = 0;    ///< points that the input's options exclude
  std::int64_t ThinnedOut = 0; ///< points that thinning removed
  Box3 Bounds;                 ///< of the finite points; coordinates times Factor
  /// A power of two that brings very small or large coordinates to about 1; else 1.
  double Factor = 1;
  int Dimension = -1;        ///< of the finite points; see Tetrahedralization
  std::size_t Elevation = 0; ///< index of the column with the third coordinate

  /// Returns the number of finite points.
  std::int64_t finite() const { return this->Points - this->Rejected; }
};

/// A point of the initial mesh.
struct InitialPoint3
{
  std::int64_t Index; ///< among all spilled points
  Point3 Position;    ///< times InputSurvey3::Factor
};

/// The pieces of a triangulation in space out of core. Each piece is one partition, which is
/// spilled, loaded, triangulated and written as a whole.
///
/// The points are surveyed in one pass (two if coordinates may have to be scaled) and spilled in
/// another one. Results do not depend on the number of threads. Points are identified by their
/// index among all spilled points, which are sorted by piece.
class VTKTIPPFILTERS_EXPORT PiecePlan3
{
public:
  /// Called with the number of finished points; throws to stop the run.
  using Progress = std::function<void(std::int64_t)>;

  /// Surveys the points. Throws IOError, also if there is no finite point, or all are in one plane.
  PiecePlan3(PointStream& points, const MemoryPlan3& memory, const Progress& progress);

  /// Restores a saved plan. `words`: 64-bit words of a point's row; `file`: the spilled points.
  /// Throws IOError if the file does not belong to the plan.
  PiecePlan3(LoadArchive& archive, std::size_t words, const std::string& file);
  /// Saves the plan; call it after spill().
  void save(SaveArchive& archive) const;

  /// Divides space into pieces. Throws IOError if the coordinates are too large.
  void divide(const MemoryPlan3& memory, std::size_t words);

  /// Spills rows of the points to `file`, sorted by piece. Throws IOError.
  void spill(PointStream& points, const std::string& file, const MemoryPlan3& memory, int threads,
    const Progress& progress);

  const InputSurvey3& survey() const { return this->Survey; }
  PartitionIndex pieces() const { return this->Tiling.size(); }
  const Tiling3& tiling() const { return this->Tiling; }
  /// Returns the piece's box; the boxes together fill the bounds.
  const Box3& box(PartitionIndex piece) const { return this->Boxes[std::size_t(piece)]; }
  /// Bounding boxes of the pieces' points.
  const std::vector<Box3>& regions() const { return this->Regions; }
  const std::vector<Vertex3>& artificial() const { return this->Artificial; }

  /// See numberInMesh().
  std::size_t number(PartitionIndex piece) const { return numberInMesh(piece, this->pieces()); }

  /// The spilled points; valid after spill(). Their coordinates are not multiplied by Factor.
  const SpilledPoints& points() const { return *this->Spilled; }

  /// Returns the initial mesh; call it after spill().
  InitialMesh3 initialMesh() const;

private:
  struct Labels;
  using Sampled = SampledPointOf<Point3>;

  void findFactor(PointStream& points, std::size_t blockPoints, double largest);
  bool samplePays() const;
  void enclose();
  void chooseInitialPoints();
  PointBuckets3 initialBuckets() const;

  InputSurvey3 Survey;
  std::vector<Sampled> Sample; ///< ascending ids; after divide(), only the initial points
  Tiling3 Tiling{ {}, 1 };
  std::vector<Box3> Boxes;
  std::vector<Box3> Regions;
  std::vector<Vertex3> Artificial;
  std::vector<std::vector<InitialPoint3>> Initial; ///< by piece
  std::unique_ptr<SpilledPoints> Spilled;
};

} // namespace tipp

#endif
