// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceTree.h"
#include "Predicates/ExactPredicates3.h"

#include "ExactClipping.h"

#include <gtest/gtest.h>

#include <algorithm>

using tipp::Box3;
using tipp::Point3;

namespace
{

double longest(const Box3& box)
{
  return std::max({ box.width(0), box.width(1), box.width(2) });
}

class Recursion
{
public:
  Recursion(const CellSet& cells, std::int64_t threshold)
    : Cells(cells)
    , Threshold(threshold)
  {
  }

  void run(const Box3& box, const std::vector<std::size_t>& candidates, int depth)
  {
    std::vector<std::size_t> meeting;
    std::int64_t fitting = 0;
    for (const std::size_t cell : candidates)
    {
      if (this->meets(cell, box))
      {
        meeting.push_back(cell);
        fitting += this->length(cell) <= longest(box) ? 1 : 0;
      }
    }
    if (fitting <= this->Threshold || depth == tipp::BoxTiling::MaxDepth)
    {
      this->Leaves.push_back(box);
      return;
    }
    const int children = this->Cells.Dimension == 2 ? 4 : 8;
    for (int which = 0; which < children; ++which)
    {
      Box3 child = box;
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->Cells.Dimension); ++axis)
      {
        const double middle = (box.Min[axis] + box.Max[axis]) / 2;
        ((which >> axis & 1) != 0 ? child.Min : child.Max)[axis] = middle;
      }
      this->run(child, meeting, depth + 1);
    }
  }

  std::vector<Box3> Leaves;

private:
  Point3 corner(std::size_t cell, std::size_t i) const
  {
    const auto dimension = static_cast<std::size_t>(this->Cells.Dimension);
    const double* p = this->Cells.Coordinates.data() +
      (cell * static_cast<std::size_t>(this->Cells.Corners) + i) * dimension;
    return { p[0], p[1], dimension == 3 ? p[2] : 0.0 };
  }

  bool meets(std::size_t cell, const Box3& box) const
  {
    const Point3 a = this->corner(cell, 0);
    const Point3 b = this->corner(cell, 1);
    const Point3 c = this->corner(cell, 2);
    return this->Cells.Corners == 3
      ? oracle::triangleMeetsBox({ a, b, c }, box)
      : oracle::tetrahedronMeetsBox({ a, b, c, this->corner(cell, 3) }, box);
  }

  double length(std::size_t cell) const
  {
    const auto stride = static_cast<std::size_t>(this->Cells.Dimension * this->Cells.Corners);
    const auto begin = this->Cells.Coordinates.begin() + static_cast<std::ptrdiff_t>(cell * stride);
    const CellSet alone = { this->Cells.Dimension, this->Cells.Corners,
      { begin, begin + static_cast<std::ptrdiff_t>(stride) } };
    return longest(alone.bounds());
  }

  const CellSet& Cells;
  std::int64_t Threshold;
};

} // namespace

std::vector<Box3> referenceTree(const CellSet& cells, std::int64_t threshold)
{
  std::vector<std::size_t> all(cells.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i] = i;
  }
  Recursion recursion(cells, threshold);
  recursion.run(cells.bounds(), all, 0);
  return recursion.Leaves;
}

tipp::CellSource sourceOf(const CellSet& cells)
{
  tipp::CellSource source;
  source.Dimension = cells.Dimension;
  source.Corners = cells.Corners;
  source.Cells = static_cast<std::int64_t>(cells.size());
  source.Read = [&cells](std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
  {
    const auto stride = static_cast<std::ptrdiff_t>(cells.Dimension) * cells.Corners;
    const auto begin = cells.Coordinates.begin() + first * stride;
    coordinates.assign(begin, begin + count * stride);
  };
  return source;
}

void expectTree(const std::vector<Box3>& expected, const tipp::BoxTiling& actual)
{
  ASSERT_EQ(static_cast<std::int64_t>(expected.size()), actual.count());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const Box3& box = actual.box(static_cast<std::int64_t>(i));
    EXPECT_EQ(expected[i].Min, box.Min) << "leaf " << i;
    EXPECT_EQ(expected[i].Max, box.Max) << "leaf " << i;
  }
}
