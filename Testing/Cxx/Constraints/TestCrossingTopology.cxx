// SPDX-License-Identifier: BSD-3-Clause
// Which segments cross, compared with CGAL's constrained triangulation with exact intersections.
#include "Comparison.h"
#include "ConstrainedOracle.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <set>
#include <utility>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// The numbers of vertices and of edges on constraints.
using Counts = std::pair<std::size_t, std::size_t>;

Counts countsOfCgal(const Coordinates& xy, const std::vector<Constraint>& constraints)
{
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_intersections_tag>
    mesh;
  const auto at = [&xy](std::int64_t id)
  { return Kernel::Point_2(xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1]); };
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    mesh.insert(at(std::int64_t(i)));
  }
  for (const Constraint& constraint : constraints)
  {
    if (at(constraint.A) != at(constraint.B))
    {
      mesh.insert_constraint(at(constraint.A), at(constraint.B));
    }
  }
  std::size_t edges = 0;
  for (auto edge = mesh.finite_edges_begin(); edge != mesh.finite_edges_end(); ++edge)
  {
    edges += mesh.is_constrained(*edge) ? 1 : 0;
  }
  return { mesh.number_of_vertices(), edges };
}

Counts countsOfTipp(const Coordinates& xy, const std::vector<Constraint>& constraints)
{
  const ConstrainedTriangulation result = triangulateConstrained(view(xy), constraints);
  std::set<std::pair<PointId, PointId>> edges;
  for (const IdSegment& segment : result.Constraints.Segments)
  {
    edges.insert(std::minmax(segment.A, segment.B));
  }
  return { xy.size() / 2 + result.Constraints.Crossings.size() - result.Mesh.Duplicates.size(),
    edges.size() };
}

/// Compares random segments between points of a lattice with `side` points per row.
void compareRandom(std::uint64_t side, int segments, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  Coordinates xy;
  std::vector<Constraint> constraints;
  for (int i = 0; i < segments; ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      xy.push_back(double(random() % side));
    }
    constraints.push_back({ 2 * i, 2 * i + 1 });
  }
  EXPECT_EQ(countsOfCgal(xy, constraints), countsOfTipp(xy, constraints))
    << side << " " << segments << " " << seed;
}

TEST(CrossingTopology, OfRandomSegmentsEqualsExactCoordinates)
{
  for (std::uint64_t seed = 0; seed < 10; ++seed)
  {
    compareRandom(1000000, 50, seed);
  }
}

/// In a small lattice, many segments cross at one point, overlap, or end on each other.
TEST(CrossingTopology, OfLatticeSegmentsEqualsExactCoordinates)
{
  for (std::uint64_t seed = 0; seed < 60; ++seed)
  {
    compareRandom(8, 12, seed);
  }
}

} // namespace
