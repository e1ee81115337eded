// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryTesting_h
#define tippQueryTesting_h

#include "SourceMesh.h"
#include "TemporaryFolder.h"

#include "Query/ResidentMesh.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// The mesh in memory with its arrays "value", "label" and, at the step, "level". With `part` and
/// `parts` only every n-th cell, with global ids.
MeshPart inMemory(const SourceMesh& source, int step = 0, int part = 0, int parts = 1);

/// Stores the mesh as `path`.
void store(
  const SourceMesh& source, const std::string& path, const std::string& tiling, bool duplicate);

/// Corners, middles of edges, points on the lines of a grid of 4 x 4, and points at random in and
/// around the mesh.
std::vector<Point3> pointsAround(const SourceMesh& source, int atRandom);

/// Calls work(mesh) for the mesh in memory and stored in several ways.
void withEachMesh(const SourceMesh& source, const std::function<void(const ResidentMesh&)>& work);

/// The source without every n-th cell: holes, and parts that touch at points.
SourceMesh withHoles(SourceMesh source, std::int64_t every);

/// The coordinates of a point of the mesh.
Point3 pointOf(const SourceMesh& source, std::int64_t id);

/// Bit by bit, but for keys.
void expectEqual(const MeshAnswer& expected, const MeshAnswer& answer);

} // namespace test
} // namespace tipp

#endif
