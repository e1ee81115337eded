// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <algorithm>

namespace tipp
{
namespace
{

constexpr const char* kind = "a file of Triangle";

void nextRow(NumberRows& rows, std::size_t fields, const char* what)
{
  rows.next(fields, what);
  for (std::size_t field = 0; field < rows.fields(); ++field)
  {
    rows.number(field); // also checks the fields that are not used
  }
}

/// Reads a row whose first field is the number of rows that follow, of the things `what`.
std::int64_t nextCount(NumberRows& rows, const char* what)
{
  nextRow(rows, 1, what);
  const std::int64_t count = rows.integer(0);
  if (count < 0 || count > rows.remainingLines())
  {
    rows.fail("announces " + std::to_string(count) + " lines, but the file has fewer.");
  }
  return count;
}

/// The vertices of a file, numbered from 0 or 1 there.
struct Vertices
{
  std::vector<double> XY;
  std::int64_t First = 0;
};

Vertices readVertices(NumberRows& rows)
{
  Vertices vertices;
  const std::int64_t count = nextCount(rows, "the number of vertices");
  for (std::int64_t i = 0; i < count; ++i)
  {
    nextRow(rows, 3, "a vertex");
    vertices.First = i == 0 ? rows.integer(0) : vertices.First;
    if (rows.integer(0) != vertices.First + i || vertices.First < 0 || vertices.First > 1)
    {
      rows.fail("numbers a vertex otherwise than from 0 or 1 on, one after the other.");
    }
    vertices.XY.push_back(rows.number(1));
    vertices.XY.push_back(rows.number(2));
  }
  return vertices;
}

} // namespace

ConstraintTable readPolyFile(const std::string& path)
{
  NumberRows rows(path, kind, '#');
  Vertices vertices = readVertices(rows);
  if (vertices.XY.empty())
  {
    NumberRows nodes(path.substr(0, path.rfind('.')) + ".node", kind, '#');
    vertices = readVertices(nodes);
  }
  const std::int64_t count = std::int64_t(vertices.XY.size() / 2);
  ConstraintTable table;
  table.XY = std::move(vertices.XY);
  const std::int64_t segments = nextCount(rows, "the number of segments");
  for (std::int64_t i = 0; i < segments; ++i)
  {
    nextRow(rows, 3, "a segment");
    const std::int64_t a = rows.integer(1) - vertices.First;
    const std::int64_t b = rows.integer(2) - vertices.First;
    if (std::min(a, b) < 0 || std::max(a, b) >= count)
    {
      rows.fail("names a vertex that is not given.");
    }
    table.Edges.push_back({ a, b });
  }
  table.PolygonBegin = table.Edges.size();
  const std::int64_t holes = nextCount(rows, "the number of holes");
  for (std::int64_t i = 0; i < holes; ++i)
  {
    nextRow(rows, 3, "a hole");
    table.Holes.push_back(rows.number(1));
    table.Holes.push_back(rows.number(2));
  }
  return table;
}

} // namespace tipp
