// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRealData_h
#define tippRealData_h

#include "DelaunayOracle.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// The path of a file of the real data sets, or an empty string if the file does not exist.
std::string realData(const std::string& name);

/// A mesh in ADCIRC's format. Ids start at 0 here, at 1 in the file.
struct AdcircMesh
{
  Coordinates Nodes;
  std::vector<Triangle> Elements; ///< in the order of the file
};

/// Reads a mesh in ADCIRC's format. Throws std::runtime_error if the file is not such a mesh.
AdcircMesh readAdcirc(const std::string& path);

/// A mesh of tetrahedra.
struct TetrahedralMesh
{
  std::vector<double> Points;
  std::vector<std::int64_t> Cells; ///< four point ids per tetrahedron
};

/// Reads a compressed mesh of tetrahedra in dolfin's XML, with one element per line. Throws
/// std::runtime_error if the file has no tetrahedra.
TetrahedralMesh readDolfin(const std::string& path);

/// Reads columns `x` and `y`, counted from 0, of an .xz-compressed table. Throws std::runtime_error
/// if it cannot be read.
Coordinates readCompressedTable(
  const std::string& path, char separator, bool header, std::size_t x, std::size_t y);

} // namespace test
} // namespace tipp

/// Skips a test if the real data set is missing.
#define TIPP_REQUIRE_REAL_DATA(path, name)                                                         \
  const std::string path = tipp::test::realData(name);                                             \
  if (path.empty())                                                                                \
  {                                                                                                \
    GTEST_SKIP() << "there is no " << (name)                                                       \
                 << "; name the folder of the real data by -DTIPP_SHARED_DATA=...";                \
  }

#endif
