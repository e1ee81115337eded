// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulate_h
#define tippTriangulate_h

#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulation.h"
#include "vtkTIPPFiltersModule.h"

#include <functional>

namespace tipp
{

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
  int Threads = 0; ///< 0: defaultThreads()
  /// Triangles with a longer edge are removed from the result, in the points' unit of length; 0:
  /// none.
  double MaximumEdge = 0;
  PartitionEditors* Editors = nullptr; ///< of interior triangles; null: none
  /// Called now and then with the finished fraction (0 to 1), by one thread at a time; returning
  /// false aborts the run.
  std::function<bool(double)> Progress;
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
