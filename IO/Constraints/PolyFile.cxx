// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace tipp
{
namespace
{

/// Reads the rows of numbers of a .poly file, skipping comments and empty lines.
class PolyRows
{
public:
  explicit PolyRows(const std::string& path)
    : Path(path)
    , Text(readTextFile(path))
    , Lines(this->Text)
  {
  }

  /// Returns false at the end of the file.
  bool next()
  {
    std::string_view line;
    while (this->Lines.next(line))
    {
      line = line.substr(0, line.find('#'));
      std::vector<std::string_view> fields;
      splitFields(line, ' ', fields);
      this->Row.clear();
      for (const std::string_view field : fields)
      {
        double value = 0;
        if (!trimField(field).empty() && !parseNumber(field, value))
        {
          this->fail("has a field that is no number.");
        }
        if (!trimField(field).empty())
        {
          this->Row.push_back(value);
        }
      }
      if (!this->Row.empty())
      {
        return true;
      }
    }
    return false;
  }

  void require(std::size_t fields, const char* what)
  {
    if (!this->next())
    {
      throw IOError(this->Path, std::string("ends before ") + what + "; copy the file again.");
    }
    if (this->Row.size() < fields)
    {
      this->fail(std::string("has too few fields for ") + what + ".");
    }
  }

  double number(std::size_t field) const { return this->Row[field]; }

  std::int64_t integer(std::size_t field) const
  {
    constexpr double most = 9007199254740992.0; // 2^53
    const double value = this->Row[field];
    if (std::floor(value) != value || std::fabs(value) > most)
    {
      this->fail("has a field that is no whole number where one is needed.");
    }
    return std::int64_t(value);
  }

  /// The first field of a row, which is the number of rows that follow.
  std::int64_t count() const
  {
    const std::int64_t result = this->integer(0);
    if (result < 0 || result > std::int64_t(this->Text.size()))
    {
      this->fail("announces " + std::to_string(result) + " lines, but the file has fewer.");
    }
    return result;
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Path, this->Lines.lineNumber(), problem);
  }

private:
  const std::string Path;
  const std::string Text;
  LineReader Lines;
  std::vector<double> Row;
};

/// The vertices of a file, numbered from 0 or 1 there.
struct Vertices
{
  std::vector<double> XY;
  std::int64_t First = 0;
};

Vertices readVertices(PolyRows& rows)
{
  Vertices vertices;
  const std::int64_t count = rows.count();
  for (std::int64_t i = 0; i < count; ++i)
  {
    rows.require(3, "a vertex");
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
  PolyRows rows(path);
  rows.require(1, "the number of vertices");
  Vertices vertices = readVertices(rows);
  if (vertices.XY.empty())
  {
    PolyRows nodes(path.substr(0, path.rfind('.')) + ".node");
    nodes.require(1, "the number of vertices");
    vertices = readVertices(nodes);
  }
  const std::int64_t count = std::int64_t(vertices.XY.size() / 2);
  ConstraintTable table;
  table.XY = std::move(vertices.XY);
  rows.require(1, "the number of segments");
  const std::int64_t segments = rows.count();
  for (std::int64_t i = 0; i < segments; ++i)
  {
    rows.require(3, "a segment");
    const std::int64_t a = rows.integer(1) - vertices.First;
    const std::int64_t b = rows.integer(2) - vertices.First;
    if (std::min(a, b) < 0 || std::max(a, b) >= count)
    {
      rows.fail("names a vertex that is not given.");
    }
    table.Edges.push_back({ a, b });
  }
  table.PolygonBegin = table.Edges.size();
  rows.require(1, "the number of holes");
  const std::int64_t holes = rows.count();
  for (std::int64_t i = 0; i < holes; ++i)
  {
    rows.require(3, "a hole");
    table.Holes.push_back(rows.number(1));
    table.Holes.push_back(rows.number(2));
  }
  return table;
}

} // namespace tipp
