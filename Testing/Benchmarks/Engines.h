// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBenchmarkEngines_h
#define tippBenchmarkEngines_h

#include "Constraints/ConstraintEdges.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace benchmark
{

/// The results of one run of an engine.
struct Run
{
  double Seconds = 0; ///< from points in memory to triangles in memory
  std::int64_t Triangles = 0;
  std::uint64_t Checksum = 0;         ///< of the set of triangles, independent of their order
  std::int64_t Recovered = -1;        ///< number of segments that are edges; -1: not counted
  TriangulationStatistics Statistics; ///< empty for peers
};

/// A checksum of triangles by the coordinates of their corners. It does not depend on the order of
/// triangles, or on the first corner.
class TriangleSum
{
public:
  void add(const double a[2], const double b[2], const double c[2]);
  std::uint64_t value() const { return this->Sum; }

private:
  std::uint64_t Sum = 0;
};

/// Runs tipp::triangulate().
Run runCore(const std::vector<double>& xy, const TriangulationOptions& options);
/// Runs vtkTIPPDelaunay2D, from a vtkPolyData to a vtkPolyData.
Run runFilter(const std::vector<double>& xy, const TriangulationOptions& options);
/// Runs one DelaunayKernel for all points, with one thread.
Run runKernel(const std::vector<double>& xy);
/// Runs one SweepKernel for all points, with one thread.
Run runSweep(const std::vector<double>& xy);
/// Runs CGAL's Delaunay_triangulation_2 with EPICK and range insertion, on one thread, without ids.
Run runCgal(const std::vector<double>& xy);
/// Runs vtkDelaunay2D with its defaults.
Run runVtk(const std::vector<double>& xy);

///@{
/// Runs a constrained triangulation: tipp::triangulateConstrained(), CGAL's
/// Constrained_Delaunay_triangulation_2 without intersections, or vtkDelaunay2D with a source.
Run runConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments,
  const TriangulationOptions& options);
Run runCgalConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments);

/// Refines what segments enclose until no angle is below `angle` degrees and no edge longer than
/// that of the equilateral triangle of an area.
Run runCgalMesh(const std::vector<double>& xy, const std::vector<Constraint>& segments,
  double angle, double area);
Run runVtkConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments);
///@}

} // namespace benchmark
} // namespace tipp

#endif
