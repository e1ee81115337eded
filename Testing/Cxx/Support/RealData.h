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

/// The path of a file of the real data sets, or an empty string if it is not there.
std::string realData(const std::string& name);

/// A mesh in ADCIRC's format: its elements, which are counted from 1 there, by ids from 0.
struct AdcircMesh
{
  Coordinates Nodes;
  std::vector<Triangle> Elements; ///< in the file's order
};

/// Throws std::runtime_error if the file is not such a mesh.
AdcircMesh readAdcirc(const std::string& path);

/// Tetrahedra with x, y and z of their points.
struct TetrahedralMesh
{
  std::vector<double> Points;
  std::vector<std::int64_t> Cells; ///< four ids each
};

/// A mesh of tetrahedra as dolfin writes it, compressed: an element a line. Throws
/// std::runtime_error if there is none in the file.
TetrahedralMesh readDolfin(const std::string& path);

/// Two columns, counted from 0, of an .xz-compressed table. Throws std::runtime_error.
Coordinates readCompressedTable(
  const std::string& path, char separator, bool header, std::size_t x, std::size_t y);

} // namespace test
} // namespace tipp

/// Ends a test visibly where the real data set is absent.
#define TIPP_REQUIRE_REAL_DATA(path, name)                                                         \
  const std::string path = tipp::test::realData(name);                                             \
  if (path.empty())                                                                                \
  {                                                                                                \
    GTEST_SKIP() << "there is no " << (name)                                                       \
                 << "; name the folder of the real data by -DTIPP_SHARED_DATA=...";                \
  }

#endif
