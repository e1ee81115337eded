// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBenchmarkEngines_h
#define tippBenchmarkEngines_h

#include "Constraints/TriangulateConstrained.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace benchmark
{

/// What one run of one engine tells.
struct Run
{
  double Seconds = 0; ///< points in memory to triangles in memory
  std::int64_t Triangles = 0;
  std::uint64_t Checksum = 0;         ///< of the set of triangles, whatever their order
  std::int64_t Recovered = -1;        ///< segments that are edges; -1: not counted
  TriangulationStatistics Statistics; ///< empty for the peers
};

/// An order-independent checksum of triangles given by the coordinates of their corners.
class TriangleSum
{
public:
  void add(const double a[2], const double b[2], const double c[2]);
  std::uint64_t value() const { return this->Sum; }

private:
  std::uint64_t Sum = 0;
};

/// tipp::triangulate.
Run runCore(const std::vector<double>& xy, const TriangulationOptions& options);
/// vtkTIPPDelaunay2D from a vtkPolyData to a vtkPolyData.
Run runFilter(const std::vector<double>& xy, const TriangulationOptions& options);
/// One DelaunayKernel for all points, one thread.
Run runKernel(const std::vector<double>& xy);
/// One SweepKernel for all points, one thread.
Run runSweep(const std::vector<double>& xy);
/// CGAL's Delaunay_triangulation_2, EPICK, range insert, one thread, without ids.
Run runCgal(const std::vector<double>& xy);
/// vtkDelaunay2D with its defaults.
Run runVtk(const std::vector<double>& xy);

///@{
/// With constraints: tipp::triangulateConstrained, CGAL's Constrained_Delaunay_triangulation_2
/// without intersections, vtkDelaunay2D with a source.
Run runConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments,
  const TriangulationOptions& options);
Run runCgalConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments);
Run runVtkConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments);
///@}

} // namespace benchmark
} // namespace tipp

#endif
