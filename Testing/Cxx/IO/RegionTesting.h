// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRegionTesting_h
#define tippRegionTesting_h

#include "Arrays/Random.h"
#include "Points/ReadPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace tipp::test
{

/// Returns the points of a table that lie in a box.
inline PointTable filtered(const PointTable& table, const Box2& box)
{
  PointTable kept;
  for (const std::string& name : table.names())
  {
    kept.Columns.push_back({ name, {} });
  }
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    const Point2 p{ table.XY[2 * i], table.XY[2 * i + 1] };
    if (box.contains(p))
    {
      kept.XY.insert(kept.XY.end(), { p.x, p.y });
      for (std::size_t c = 0; c < table.Columns.size(); ++c)
      {
        kept.Columns[c].Values.push_back(table.Columns[c].Values[i]);
      }
    }
  }
  return kept;
}

inline void expectSameTable(const PointTable& expected, const PointTable& points)
{
  EXPECT_EQ(expected.XY, points.XY);
  ASSERT_EQ(expected.names(), points.names());
  for (std::size_t c = 0; c < expected.Columns.size(); ++c)
  {
    EXPECT_EQ(expected.Columns[c].Values, points.Columns[c].Values) << expected.Columns[c].Name;
  }
}

/// Returns boxes within and around the points, also flat ones and one beside them.
inline std::vector<Box2> regionsOf(const PointTable& table, int count)
{
  Box2 all = Box2::empty();
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    all.extend(Point2{ table.XY[2 * i], table.XY[2 * i + 1] });
  }
  Random random(7);
  std::vector<Box2> boxes = { all, { { all.Max.x + 1, all.Min.y }, { all.Max.x + 2, all.Max.y } },
    Box2::of({ table.XY[0], table.XY[1] }) };
  const auto at = [&](std::size_t axis)
  { return all.Min[axis] + (1.2 * random.uniform() - 0.1) * all.width(axis); };
  while (boxes.size() < std::size_t(count))
  {
    boxes.push_back(Box2::of({ at(0), at(1) }, { at(0), at(1) }));
  }
  return boxes;
}

/// Expects that reading regions of a file gives the points that filtering all of them does, for
/// some numbers of threads and shares.
inline void expectFiltered(
  const std::string& path, int regions = 10, const PointOptions& given = {})
{
  const PointTable all = readPoints(path, given);
  ASSERT_GT(all.size(), 0U);
  for (const Box2& box : regionsOf(all, regions))
  {
    const PointTable expected = filtered(all, box);
    PointOptions options = given;
    options.Region = box;
    options.Threads = 3;
    expectSameTable(expected, readPoints(path, options));
    options.Threads = 1;
    const PointTable points = readPoints(path, options);
    expectSameTable(expected, points);
    EXPECT_LE(points.LeftOut, all.LeftOut);
    std::vector<double> parts;
    for (int part = 0; part < 2; ++part)
    {
      const PointTable share = readPointsShare({ path }, options, part, 2);
      parts.insert(parts.end(), share.XY.begin(), share.XY.end());
    }
    EXPECT_EQ(expected.XY, parts);
  }
}

} // namespace tipp::test

#endif
