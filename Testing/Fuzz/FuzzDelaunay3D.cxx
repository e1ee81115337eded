// SPDX-License-Identifier: BSD-3-Clause
// Draws points in space, triangulates them with several partitions and threads, and checks the
// result with an exact checker. A seed and a number identify a case: 'fuzzDelaunay3D --seed S
// --case N' repeats it.
#include "Check/TetrahedraChecker.h"
#include "DegeneratePoints.h"
#include "FuzzDriver.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace
{

using namespace tipp;
using namespace tipp::test;

Tetrahedralization meshOf(const Coordinates& xyz, int partitions, int threads)
{
  std::vector<Point3> points;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
  {
    points.push_back({ xyz[i], xyz[i + 1], xyz[i + 2] });
  }
  TetrahedralizationOptions options;
  options.Partitions = partitions;
  options.Threads = threads;
  return tetrahedralize(points.data(), points.size(), options);
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

std::string faultOf(const Coordinates& xyz, const Tetrahedralization& mesh)
{
  const std::vector<std::int64_t> ids(mesh.Ids.begin(), mesh.Ids.end());
  const std::vector<std::string> faults = checkTetrahedra(xyz, ids, true).faults();
  // Points in a plane have no tetrahedra, and no lists.
  return !faults.empty() ? faults.front() : mesh.Dimension == 3 ? faultOfLists(xyz, mesh) : "";
}

/// Runs one case, and prints its points if it fails.
bool passes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq both{ seed, number };
  Engine random(both);
  const Coordinates xyz = drawDegeneratePointsInSpace(random);
  const int partitions = 1 + int(random() % 9);
  const int threads = 1 + int(random() % 3);
  const Tetrahedralization mesh = meshOf(xyz, partitions, threads);
  std::string fault = faultOf(xyz, mesh);
  const Tetrahedralization whole = meshOf(xyz, 1, 1);
  if (fault.empty() &&
    !std::equal(mesh.Ids.begin(), mesh.Ids.end(), whole.Ids.begin(), whole.Ids.end()))
  {
    fault = "one partition gives other tetrahedra";
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
