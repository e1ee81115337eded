// SPDX-License-Identifier: BSD-3-Clause
#include "Query/WriteLines.h"

#include "Files/WriteVtkXml.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The ids of the points of lines, and the end of each line among them.
struct LineCells
{
  std::vector<std::int64_t> Ids;
  std::vector<std::int64_t> Ends;
};

/// Returns a cell for each list of successive points that is not empty. VTK crashes on a line of
/// one point (vtkPolyData::GetCellType in 9.1), so such a line has its point twice.
LineCells cellsOf(const std::vector<std::int64_t>& starts)
{
  LineCells cells;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
  {
    for (std::int64_t id = starts[i]; id < starts[i + 1]; ++id)
    {
      cells.Ids.push_back(id);
    }
    if (starts[i + 1] == starts[i] + 1)
    {
      cells.Ids.push_back(starts[i]);
    }
    if (starts[i + 1] > starts[i])
    {
      cells.Ends.push_back(std::int64_t(cells.Ids.size()));
    }
  }
  return cells;
}

template <typename T>
XmlArray arrayOf(const std::string& name, const std::vector<T>& values)
{
  return xmlArray(name, values.data(), values.size());
}

void writeLines(const std::string& path, const PathState& before, const std::vector<Point3>& points,
  const std::vector<std::int64_t>& starts, XmlSection pointData, XmlSection cellData)
{
  const LineCells cells = cellsOf(starts);
  const auto coordinate = [&points](std::size_t i)
  {
    const Point3& point = points[i / 3];
    return i % 3 == 0 ? point.x : i % 3 == 1 ? point.y : point.z;
  };
  const XmlPiece piece{ "PolyData",
    { { "NumberOfPoints", points.size() }, { "NumberOfVerts", 0 },
      { "NumberOfLines", cells.Ends.size() }, { "NumberOfStrips", 0 }, { "NumberOfPolys", 0 } },
    { std::move(pointData), std::move(cellData),
      { "Points", { computedXmlArray<double>("Points", 3 * points.size(), coordinate, 3) }, "" },
      { "Lines", { arrayOf("connectivity", cells.Ids), arrayOf("offsets", cells.Ends) }, "" } } };
  writeXmlPiece(path, before, piece);
}

} // namespace

void writeContours(const std::string& path, const PathState& before, const Contours& contours,
  const std::string& name)
{
  writeLines(path, before, contours.Points, contours.Starts, { "PointData", {}, "" },
    { "CellData", { arrayOf(name, contours.Levels) }, name });
}

void writeDescents(const std::string& path, const PathState& before, const Descents& descents,
  const std::string& name)
{
  std::vector<std::int64_t> numbers;
  std::vector<std::int64_t> pits;
  for (std::size_t i = 0; i < descents.Pits.size(); ++i)
  {
    if (descents.Starts[i + 1] > descents.Starts[i])
    {
      numbers.push_back(std::int64_t(i));
      pits.push_back(descents.Pits[i]);
    }
  }
  writeLines(path, before, descents.Points, descents.Starts,
    { "PointData", { arrayOf(name, descents.Values) }, name },
    { "CellData", { arrayOf("StartId", numbers), arrayOf("PitId", pits) }, "" });
}

} // namespace tipp
