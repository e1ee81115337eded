// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulation_h
#define tippTriangulation_h

#include "Arrays/Buffer.h"
#include "Engine/PartitionIndex.h"
#include "Triangulation/Duplicate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

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

} // namespace tipp

#endif
