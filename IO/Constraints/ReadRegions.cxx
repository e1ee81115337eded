// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadRegions.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Models/TriangleFiles.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tipp
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Reads the regions of a .poly file (https://www.cs.cmu.edu/~quake/triangle.poly.html).
std::vector<RegionLimit> readPolyRegions(const std::string& path)
{
  NumberRows rows(path, triangleFileKind, '#');
  readTriangleVertices(rows);
  for (const char* const skipped : { "a segment", "a hole" })
  {
    const std::int64_t count = nextTriangleCount(rows, "the number of segments or holes");
    for (std::int64_t i = 0; i < count; ++i)
    {
      nextTriangleRow(rows, 3, skipped);
    }
  }
  std::vector<RegionLimit> regions;
  if (!rows.nextIfAny())
  {
    return regions; // the list may be left out
  }
  rows.require(1, "the number of regions");
  const std::int64_t count = rows.integer(0);
  for (std::int64_t i = 0; i < count; ++i)
  {
    nextTriangleRow(rows, 4, "a region");
    const double area = rows.number(rows.fields() > 4 ? 4 : 3);
    regions.push_back({ { rows.number(1), rows.number(2) }, area > 0 ? area : infinity });
  }
  return regions;
}

std::vector<RegionLimit> readPointRegions(const std::string& path)
{
  const PointTable points = readPoints({ path }, {});
  const std::vector<std::string> names = points.names();
  const auto find = [&names](const char* name)
  { return std::size_t(std::find(names.begin(), names.end(), name) - names.begin()); };
  const bool isArea = find("area") < names.size();
  if (isArea == (find("size") < names.size()))
  {
    throw IOError(path,
      isArea ? "has the columns 'area' and 'size'; remove one of them."
             : "has no column 'area' or 'size'; name the column that limits the triangles of "
               "regions so.");
  }
  const std::vector<double>& values = points.Columns[find(isArea ? "area" : "size")].Values;
  std::vector<RegionLimit> regions;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (!(values[i] > 0))
    {
      throw IOError(path,
        std::string("has the ") + (isArea ? "area " : "size ") + shortText(values[i]) +
          " at point " + std::to_string(i) + " (counted from 0); give numbers above 0.");
    }
    const double area = isArea ? values[i] : std::sqrt(3.0) / 4 * values[i] * values[i];
    regions.push_back({ { points.XY[2 * i], points.XY[2 * i + 1] }, area });
  }
  return regions;
}

} // namespace

std::vector<RegionLimit> readRegions(const std::string& path)
{
  std::vector<RegionLimit> regions = openerOf(path, Use::Constraints) == Opener::Triangle
    ? readPolyRegions(path)
    : readPointRegions(path);
  if (regions.empty())
  {
    throw IOError(path, "lists no regions; leave it out, or add them.");
  }
  return regions;
}

} // namespace tipp
