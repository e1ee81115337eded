// SPDX-License-Identifier: BSD-3-Clause
// Draws points in space, triangulates them with several partitions and threads, and checks the
// result with an exact checker; triangles of points in one plane are compared with the oracle. A
// seed and a number identify a case: 'fuzzDelaunay3D --seed S --case N' repeats it.
#include "Check/DelaunayChecker.h"
#include "Comparison.h"
#include "DegeneratePoints.h"
#include "FuzzDriver.h"
#include "Predicates/ExactPredicates3.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

struct Result
{
  Tetrahedralization Mesh;
  Triangulation Triangles; ///< of points in one plane
};

Result resultOf(const std::vector<Point3>& points, int partitions, int threads)
{
  TetrahedralizationOptions options;
  options.Partitions = partitions;
  options.Threads = threads;
  Result result;
  result.Mesh = tetrahedralize(points.data(), points.size(), options);
  if (result.Mesh.Dimension == 2)
  {
    result.Triangles = triangulateCoplanar(points.data(), points.size(), options, result.Mesh);
  }
  return result;
}

/// Describes an error in the lists of duplicates and rejected points; an empty string if there is
/// none.
std::string faultOfLists(const Coordinates& xyz, const Tetrahedralization& mesh)
{
  std::map<std::array<double, 3>, PointId> first;
  std::vector<PointId> rejected;
  std::size_t duplicates = 0;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
  {
    const auto id = PointId(i / 3);
    if (!std::isfinite(xyz[i]) || !std::isfinite(xyz[i + 1]) || !std::isfinite(xyz[i + 2]))
    {
      rejected.push_back(id);
      continue;
    }
    // Adding 0 turns -0 into +0.
    const auto [at, isNew] =
      first.emplace(std::array<double, 3>{ xyz[i] + 0.0, xyz[i + 1] + 0.0, xyz[i + 2] + 0.0 }, id);
    if (isNew)
    {
      continue;
    }
    const bool isListed = duplicates < mesh.Duplicates.size() &&
      mesh.Duplicates[duplicates].Point == id &&
      mesh.Duplicates[duplicates].Representative == at->second;
    if (!isListed)
    {
      return "point " + std::to_string(id) + " is not listed as a duplicate";
    }
    ++duplicates;
  }
  return duplicates != mesh.Duplicates.size() ? "a point is listed as a duplicate wrongly"
    : rejected != mesh.Rejected               ? "the rejected points are not those expected"
                                              : "";
}

/// Describes an error in the triangles of points in one plane; an empty string if there is none.
std::string faultOfTriangles(const std::vector<Point3>& points, const Triangulation& triangles)
{
  const auto corner = [&](std::size_t i) { return points[std::size_t(triangles.Ids32[i])]; };
  if (triangles.Ids32.size() == 0)
  {
    return "there are no triangles";
  }
  const auto axis = std::size_t(normalAxis(corner(0), corner(1), corner(2)));
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Coordinates projected;
  for (const Point3& p : points)
  {
    const bool isFinite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    const std::array<double, 3> at = { p.x, p.y, p.z };
    projected.push_back(isFinite ? at[(axis + 1) % 3] : none);
    projected.push_back(isFinite ? at[(axis + 2) % 3] : none);
  }
  const auto outcome = matches(projected, triangles, reference(projected));
  return outcome ? "" : outcome.message();
}

std::string faultOf(const Coordinates& xyz, const std::vector<Point3>& points, const Result& result)
{
  const Tetrahedralization& mesh = result.Mesh;
  const std::vector<std::int64_t> ids(mesh.Ids.begin(), mesh.Ids.end());
  const std::vector<std::string> faults = checkTetrahedra(xyz, ids, true).faults();
  std::string fault = !faults.empty() ? faults.front() : "";
  if (fault.empty() && mesh.Dimension >= 2) // points on a line have no lists
  {
    fault = faultOfLists(xyz, mesh);
  }
  return fault.empty() && mesh.Dimension == 2 ? faultOfTriangles(points, result.Triangles) : fault;
}

template <typename Ids>
bool areEqual(const Ids& a, const Ids& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// Runs one case, and prints its points if it fails.
bool passes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq both{ seed, number };
  Engine random(both);
  const Coordinates xyz = drawDegeneratePointsInSpace(random);
  const int partitions = 1 + int(random() % 9);
  const int threads = 1 + int(random() % 3);
  std::vector<Point3> points;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
  {
    points.push_back({ xyz[i], xyz[i + 1], xyz[i + 2] });
  }
  const Result result = resultOf(points, partitions, threads);
  std::string fault = faultOf(xyz, points, result);
  const Result whole = resultOf(points, 1, 1);
  const bool areSame = areEqual(result.Mesh.Ids, whole.Mesh.Ids) &&
    areEqual(result.Triangles.Ids32, whole.Triangles.Ids32);
  if (fault.empty() && !areSame)
  {
    fault = "one partition gives another result";
  }
  if (fault.empty())
  {
    return true;
  }
  std::printf("case %llu of seed %llu, %d partitions, %d threads: %s\n", (unsigned long long)number,
    (unsigned long long)seed, partitions, threads, fault.c_str());
  for (std::size_t i = 0; i < xyz.size(); i += 3)
  {
    std::printf("  %a, %a, %a, // %zu: %.17g %.17g %.17g\n", xyz[i], xyz[i + 1], xyz[i + 2], i / 3,
      xyz[i], xyz[i + 1], xyz[i + 2]);
  }
  return false;
}

} // namespace

int main(int argc, char** argv)
{
  return fuzz("fuzzDelaunay3D", argc, argv, passes);
}
