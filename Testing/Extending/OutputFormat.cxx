// SPDX-License-Identifier: BSD-3-Clause
// An output format: OFF, a text format that many mesh programs read.
#include "Files/PendingOutput.h"
#include "Meshes/MeshFiles.h"
#include "Points/ReadPoints.h"
#include "Triangulation/Triangulate.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <sstream>

namespace
{

using namespace tipp;

/// Throws IOError if the file cannot be written. An existing file is then kept.
void writeOff(const std::string& path, const PointTable& points, TrianglesView triangles)
{
  std::ostringstream text;
  text.precision(17); // enough digits to read back the same double
  text << "OFF\n" << points.size() << ' ' << triangles.size() << " 0\n";
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    text << points.XY[2 * i] << ' ' << points.XY[2 * i + 1] << " 0\n";
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    text << 3;
    for (int corner = 0; corner < 3; ++corner)
    {
      text << ' ' << triangles.id(t, corner);
    }
    text << '\n';
  }
  const std::string content = text.str();
  PendingFile file(path);
  file.file().write(0, content.data(), content.size());
  file.commit(); // renames the file to its final path
}

TEST(ExtendingOutputFormat, WritesPointsAndTriangles)
{
  const test::TemporaryFolder folder;
  PointTable points;
  points.XY = { 0, 0, 1, 0, 0.25, 1 };
  const Triangulation mesh = triangulate(PointsView(points.XY.data(), points.size(), 2));
  writeOff(folder.path("mesh.off"), points, TrianglesView(mesh.Ids32.data(), mesh.triangleCount()));
  EXPECT_EQ(
    "OFF\n3 1 0\n0 0 0\n1 0 0\n0.25 1 0\n3 0 1 2\n", test::contentOf(folder.path("mesh.off")));
}

} // namespace
