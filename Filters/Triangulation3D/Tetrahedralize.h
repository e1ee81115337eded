// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedralize_h
#define tippTetrahedralize_h

#include "Arrays/Buffer.h"
#include "Predicates/Points.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Options of tetrahedralize(). None changes the result.
struct TetrahedralizationOptions
{
  int Partitions = 0; ///< 0: chosen for the points and threads
  int Threads = 0;    ///< 0: OpenMP's choice
  /// Called now and then with the finished fraction (0 to 1), by one thread at a time; returning
  /// false aborts the run.
  std::function<bool(double)> Progress;
};

/// The tetrahedra: four input point ids each, so that orientation3() is positive. The lowest id is
/// first, and the others ascend, but the last two are exchanged where the orientation asks for it.
/// Tetrahedra are in the lexicographic order of their ascending ids.
struct Tetrahedralization
{
  Buffer<std::int32_t> Ids;
  std::vector<Duplicate> Duplicates; ///< by ascending Point
  std::vector<PointId> Rejected;     ///< ids of points with NaN or infinite coordinates; ascending
  /// Of the finite points: -1 without any; 0 if all have the same coordinates, 1 if they are
  /// collinear, 2 if they are coplanar; else 3. Below 3 there are no tetrahedra.
  int Dimension = -1;
  TriangulationStatistics Statistics;
  bool Aborted = false;

  std::size_t cellCount() const { return this->Ids.size() / 4; }
};

/// Returns the Delaunay triangulation of the distinct finite points in space, ties broken by their
/// lexicographic order: the same set of tetrahedra as CGAL's Delaunay_triangulation_3, for all
/// options. Ids are indices into `points`. Throws std::length_error for 2^31 points and more.
VTKTIPPFILTERS_EXPORT Tetrahedralization tetrahedralize(
  const Point3* points, std::size_t count, const TetrahedralizationOptions& options = {});

/// Why points of this dimension, below 3, have no tetrahedra: a sentence.
std::string describeDimension(int dimension);

/// Returns the warnings about a tetrahedralization of `points` points, one sentence each.
VTKTIPPFILTERS_EXPORT std::vector<std::string> warningsOf(
  const Tetrahedralization& mesh, std::int64_t points);

} // namespace tipp

#endif
