// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulate_h
#define tippTriangulate_h

#include "Predicates/Box2.h"
#include "Triangulation/Buffer.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

using PointId = std::int64_t;

class PartitionEditor;

enum class Schedule
{
  Stages, ///< a barrier after each set of independent partitions (Algorithm 1)
  Dynamic ///< a partition starts as soon as it is independent of all active ones
};

struct TriangulationOptions
{
  int Columns = 0; ///< with Rows, a grid of partitions; 0: a tiling chosen for the points
  int Rows = 0;
  int InitialPointsPerPartition = 0; ///< 0: chosen
  Schedule Order = Schedule::Dynamic;
  int Threads = 0; ///< 0: OpenMP's choice
  /// Triangles with a longer edge are left out of the result; 0: none are.
  double MaximumEdge = 0;
  /// For each thread an editor of interior triangles. Factor: by which coordinates are multiplied.
  std::function<std::unique_ptr<PartitionEditor>(double factor)> MakeEditor;
  /// Told the finished fraction now and then, from one thread at a time; false aborts the run.
  std::function<bool(double)> Progress;
};

struct Duplicate
{
  PointId Point;
  PointId Representative; ///< the lowest id at the same place
};

struct TriangulationStatistics
{
  struct Stage
  {
    std::int64_t ActivePartitions;
    std::int64_t MeshTriangles; ///< unfinished triangles in memory when the stage began
  };
  struct Phase
  {
    std::string Name;
    double Seconds; ///< wall clock
  };
  std::vector<Stage> Stages;
  std::vector<Phase> Phases;
  std::int64_t Partitions = 0;
  std::int64_t InitialPoints = 0;
  std::int64_t WorkerVertices = 0; ///< triangulated by all workers together
  int Threads = 0;
};

/// Triangles in a row, all of them in a box.
struct TriangleBlock
{
  PartitionIndex Partition; ///< whose first interior triangles they are, in their order
  std::size_t Begin;
  std::size_t End;
  Box2 Box;
};

/// Counter-clockwise triangles of input point ids, three in a row.
struct Triangulation
{
  Buffer<std::int32_t> Ids32; ///< used when every id fits
  Buffer<std::int64_t> Ids64;
  std::vector<Duplicate> Duplicates; ///< by ascending Point
  std::vector<PointId> Rejected;     ///< NaN or infinite coordinates; ascending
  std::vector<TriangleBlock> Blocks; ///< most triangles, by ascending position; none where unknown
  TriangulationStatistics Statistics;
  bool Aborted = false;

  std::size_t triangleCount() const { return (this->Ids32.size() + this->Ids64.size()) / 3; }
};

/// The Delaunay triangulation of the distinct finite points, ties broken by their lexicographic
/// order: the same set of triangles for every option, and CGAL's. No triangles if there are fewer
/// than three distinct points or all are collinear.
VTKTIPPFILTERS_EXPORT Triangulation triangulate(
  PointsView points, const TriangulationOptions& options = {});

} // namespace tipp

#endif
