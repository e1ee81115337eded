// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryTesting_h
#define tippQueryTesting_h

#include "SourceMesh.h"
#include "TemporaryFolder.h"

#include "Query/ZoneShape.h"
#include "Resident/ResidentMesh.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// The mesh in memory, with its arrays "value", "label" and the given time step of "level". If
/// `parts` > 1, it has only every `parts`-th cell from `part` on, with global ids.
MeshPart inMemory(const SourceMesh& source, int step = 0, int part = 0, int parts = 1);

/// Partitions the mesh into `path`; `duplicate` copies borrowed cells into the pieces.
void store(
  const SourceMesh& source, const std::string& path, const std::string& tiling, bool duplicate);

/// Corners, middles of edges, points on the lines of a 4 x 4 grid, and random points in and around
/// the mesh.
std::vector<Point3> pointsAround(const SourceMesh& source, int atRandom);

/// Calls work(mesh) for the mesh in memory, and for several partitioned meshes made from it.
void withEachMesh(const SourceMesh& source, const std::function<void(const ResidentMesh&)>& work);

/// The source without every `every`-th cell: it has holes, and parts that touch only at points.
SourceMesh withHoles(SourceMesh source, std::int64_t every);

/// The coordinates of a point of the mesh.
Point3 pointOf(const SourceMesh& source, std::int64_t id);

/// Expects equal answers, bit by bit, except for keys.
void expectEqual(const MeshAnswer& expected, const MeshAnswer& answer);

/// A ring around a box.
inline ZoneRing rectangle(double xmin, double xmax, double ymin, double ymax, bool isHole = false)
{
  return { { { xmin, ymin }, { xmax, ymin }, { xmax, ymax }, { xmin, ymax } }, isHole };
}

} // namespace test
} // namespace tipp

#endif
