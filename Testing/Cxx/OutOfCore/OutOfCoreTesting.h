// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTesting_h
#define tippOutOfCoreTesting_h

#include "Comparison.h"
#include "MeshChecks.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "TemporaryFolder.h"

#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Writes the points as .npy and triangulates that file into mesh.tipp, both in the folder.
OutOfCoreStatistics triangulateFile(
  const TemporaryFolder& folder, const Coordinates& xy, const OutOfCoreOptions& options);

/// The triangles that pieces own, by global ids; sorted.
Triangles trianglesOfMesh(const std::string& path);

/// Is the mesh the reference? Tells the first difference.
testing::AssertionResult meshMatches(
  const std::string& path, const Coordinates& xy, const Reference& expected);

/// The mesh with its cells in the order of their global ids, to be checked against itself.
SourceMesh sourceOf(const std::string& path, const Coordinates& xy);

} // namespace test
} // namespace tipp

#endif
