// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulate_h
#define tippTriangulate_h

#include "Arrays/Buffer.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// A point's id: an index into the input points, or a global id of the caller, as stated at each
/// use.
using PointId = std::int64_t;

class PartitionEditors;

/// When partitions are started.
enum class Schedule
{
  Stages, ///< a barrier after each colour, a set of partitions without conflicts (Algorithm 1)
  Dynamic ///< a partition starts as soon as all conflicting earlier ones are done
};

/// Options of triangulate(). Only MaximumEdge and Editors change the set of triangles.
struct TriangulationOptions
{
  int Columns = 0; ///< with Rows: a grid of partitions; 0: partitions are chosen automatically
  int Rows = 0;
  int InitialPointsPerPartition = 0; ///< 0: chosen automatically
  Schedule Order = Schedule::Dynamic;
  int Threads = 0; ///< 0: OpenMP's choice
  /// Triangles with a longer edge are removed from the result, in the points' unit of length; 0:
  /// none.
  double MaximumEdge = 0;
  PartitionEditors* Editors = nullptr; ///< of interior triangles; null: none
  /// Called now and then with the finished fraction (0 to 1), by one thread at a time; returning
  /// false aborts the run.
  std::function<bool(double)> Progress;
};

/// A point that coincides with another one, its representative. Both are input point ids.
struct Duplicate
{
  PointId Point;          ///< id of the duplicate
  PointId Representative; ///< the lowest id with the same coordinates

  bool operator<(const Duplicate& other) const { return this->Point < other.Point; }
};

/// Counts and times of a run.
struct TriangulationStatistics
{
  /// The start of a stage (with barriers), or of a partition.
  struct Stage
  {
    std::int64_t ActivePartitions; ///< partitions that were being triangulated
    std::int64_t MeshTriangles;    ///< triangles in memory that were not final when the stage began
  };
  /// A phase of the run and its wall-clock time.
  struct Phase
  {
    std::string Name;
    double Seconds; ///< wall clock
  };
  std::vector<Stage> Stages;
  std::vector<Phase> Phases;
  std::int64_t Partitions = 0;
  std::int64_t InitialPoints = 0;  ///< vertices of the initial mesh, without artificial points
  std::int64_t WorkerVertices = 0; ///< sum over all workers
  int Threads = 0;
};

/// What triangulations in the plane and in space have in common, besides their cells.
struct TriangulatedPoints
{
  std::vector<Duplicate> Duplicates; ///< sorted by Point
  std::vector<PointId> Rejected;     ///< ids of points with NaN or infinite coordinates; ascending
  TriangulationStatistics Statistics;
  bool Aborted = false; ///< whether Progress stopped the run; there are no cells then
};

/// Returns for each of `points` input points 1 if it is a duplicate or rejected, else 0.
std::vector<char> findLeftOut(const TriangulatedPoints& mesh, std::int64_t points);

/// Returns for each of `points` input points the id of its representative: its own id; for a
/// duplicate, the representative's; for a rejected point, -1.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> representativeIds(
  const TriangulatedPoints& mesh, std::int64_t points);

/// A range [Begin, End) of triangles: the first interior ones of a partition, in their order.
struct TriangleBlock
{
  PartitionIndex Partition;
  std::size_t Begin;
  std::size_t End;
};

/// The triangles: three input point ids each, counter-clockwise.
struct Triangulation : TriangulatedPoints
{
  Buffer<std::int32_t> Ids32;        ///< used when every id fits
  Buffer<std::int64_t> Ids64;        ///< used otherwise; one of the two is empty
  std::vector<TriangleBlock> Blocks; ///< cover most triangles, ascending; empty if unknown

  std::size_t triangleCount() const { return (this->Ids32.size() + this->Ids64.size()) / 3; }
};

/// Returns the Delaunay triangulation of the distinct finite points, ties broken by their
/// lexicographic order: the same set of triangles as CGAL's, for all options except MaximumEdge and
/// Editors. Ids are indices into `points`. There are no triangles if there are fewer than three
/// distinct points or all are collinear.
VTKTIPPFILTERS_EXPORT Triangulation triangulate(
  PointsView points, const TriangulationOptions& options = {});

/// Removes the triangles with an edge longer than `longest`, in the points' unit of length; 0: no
/// limit. The remaining triangles may be disconnected, so the inside of polygons must be found
/// before.
VTKTIPPFILTERS_EXPORT void leaveOutLong(PointsView points, double longest, Triangulation& mesh);

} // namespace tipp

#endif
