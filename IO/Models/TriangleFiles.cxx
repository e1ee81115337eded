// SPDX-License-Identifier: BSD-3-Clause
#include "Models/TriangleFiles.h"

#include "Files/InputFile.h"
#include "Models/ModelMesh.h"

#include <utility>

namespace tipp
{

void nextTriangleRow(NumberRows& rows, std::size_t fields, const char* what)
{
  rows.next(fields, what);
  for (std::size_t field = 0; field < rows.fields(); ++field)
  {
    rows.number(field); // also checks the fields that are not used
  }
}

std::int64_t nextTriangleCount(NumberRows& rows, const char* what)
{
  nextTriangleRow(rows, 1, what);
  const std::int64_t count = rows.integer(0);
  if (count < 0 || count > rows.remainingLines())
  {
    rows.fail("announces " + std::to_string(count) + " lines, but the file has fewer.");
  }
  return count;
}

TriangleVertices readTriangleVertices(NumberRows& rows)
{
  const std::int64_t count = nextTriangleCount(rows, "the number of vertices");
  const std::int64_t dimension = rows.fields() > 1 ? rows.integer(1) : 2;
  const std::int64_t attributes = rows.fields() > 2 ? rows.integer(2) : 0;
  if (count > 0 && dimension != 2)
  {
    rows.fail("has vertices of " + std::to_string(dimension) +
      " coordinates, as TetGen's; convert it, as with 'meshio convert FILE out.vtu'.");
  }
  if (attributes < 0)
  {
    rows.fail("announces " + std::to_string(attributes) + " attributes; correct the number.");
  }
  TriangleVertices vertices;
  for (std::int64_t i = 0; i < count; ++i)
  {
    // The row has at least as many fields as attributes, however many are announced.
    nextTriangleRow(rows, 3, "a vertex");
    if (std::uint64_t(attributes) > rows.fields() - 3)
    {
      rows.fail("has fewer attributes than the " + std::to_string(attributes) +
        " announced; correct the line.");
    }
    vertices.First = i == 0 ? rows.integer(0) : vertices.First;
    if (rows.integer(0) != vertices.First + i || vertices.First < 0 || vertices.First > 1)
    {
      rows.fail("numbers a vertex otherwise than from 0 or 1 on, one after the other.");
    }
    vertices.XY.push_back(rows.number(1));
    vertices.XY.push_back(rows.number(2));
    vertices.Attributes.resize(std::size_t(attributes));
    for (std::size_t a = 0; a < vertices.Attributes.size(); ++a)
    {
      vertices.Attributes[a].push_back(rows.number(3 + a));
    }
  }
  return vertices;
}

std::string triangleFileBeside(const std::string& path, const std::string& extension)
{
  return extensionOf(path) == extension ? path : path.substr(0, path.rfind('.')) + extension;
}

namespace
{

/// Reads an .ele file: a row of the numbers of triangles, of nodes of each, and of attributes; then
/// rows `id a b c attributes`. The first attribute is the region.
void readElements(const std::string& path, const TriangleVertices& vertices, ModelMesh& mesh)
{
  NumberRows rows(path, triangleFileKind, '#');
  const std::int64_t count = nextTriangleCount(rows, "the number of triangles");
  rows.require(2, "the numbers of triangles and of nodes of each");
  if (rows.integer(1) != 3)
  {
    rows.fail("has elements of " + std::to_string(rows.integer(1)) +
      " nodes instead of triangles of three; make it without the switch -o2, or convert "
      "tetrahedra, as with 'meshio convert FILE out.vtu'.");
  }
  const bool hasRegions = rows.fields() > 2 && rows.integer(2) > 0;
  const auto nodes = std::int64_t(vertices.XY.size() / 2);
  for (std::int64_t i = 0; i < count; ++i)
  {
    nextTriangleRow(rows, hasRegions ? 5 : 4, "a triangle");
    for (std::size_t corner = 1; corner <= 3; ++corner)
    {
      const std::int64_t number = rows.integer(corner);
      if (number < vertices.First || number - vertices.First >= nodes)
      {
        rows.fail("names node " + std::to_string(number) + ", which the .node file does not have.");
      }
      mesh.Triangles.push_back(number - vertices.First);
    }
    if (hasRegions)
    {
      mesh.Regions.push_back(rows.number(4));
    }
  }
}

} // namespace

ModelMesh readTriangleMesh(const std::string& path, ModelPart part)
{
  NumberRows rows(triangleFileBeside(path, ".node"), triangleFileKind, '#');
  TriangleVertices vertices = readTriangleVertices(rows);
  ModelMesh mesh;
  for (std::size_t a = 0; a < vertices.Attributes.size(); ++a)
  {
    // Triangle's attributes have no names; of points on a terrain the first is the elevation.
    mesh.Columns.push_back(
      { a == 0 ? "z" : "attribute" + std::to_string(a + 1), std::move(vertices.Attributes[a]) });
  }
  if (part == ModelPart::Triangles)
  {
    readElements(triangleFileBeside(path, ".ele"), vertices, mesh);
  }
  mesh.XY = std::move(vertices.XY);
  return mesh;
}

} // namespace tipp
