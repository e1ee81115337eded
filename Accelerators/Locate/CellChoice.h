// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellChoice_h
#define tippCellChoice_h

#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactPredicates3.h"
#include "Resample/CellKey.h"
#include "Resample/SimplexMesh.h"

#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace tipp
{

enum class Side
{
  Outside,
  Border,
  Inside
};

/// On which side of a closed cell's border a point lies. Exact. Degenerate cells contain no point.
inline Side sideOf(const Point2 (&corners)[3], Point2 p)
{
  const auto& [a, b, c] = corners;
  const int first = orientation(a, b, p);
  const int second = orientation(b, c, p);
  if (first * second < 0)
  {
    return Side::Outside;
  }
  const int third = orientation(c, a, p);
  const int sum = first + second + third;
  if (sum == 3 || sum == -3)
  {
    return Side::Inside;
  }
  return first * third >= 0 && second * third >= 0 && orientation(a, b, c) != 0 ? Side::Border
                                                                                : Side::Outside;
}

inline Side sideOf(const Point3 (&corners)[4], const Point3& p)
{
  const auto& [a, b, c, d] = corners;
  const Point3* const faces[4][3] = { { &a, &b, &c }, { &a, &c, &d }, { &a, &d, &b },
    { &b, &d, &c } };
  const int turn = orientation3(a, b, c, d);
  Side side = turn != 0 ? Side::Inside : Side::Outside;
  for (int i = 0; i < 4 && side != Side::Outside; ++i)
  {
    const auto& [u, v, w] = faces[i];
    const int inner = turn * orientation3(*u, *v, *w, p);
    side = inner > 0 ? side : inner == 0 ? Side::Border : Side::Outside;
  }
  return side;
}

template <typename Access>
CellKey keyOfCell(const Access& access, std::int64_t cell, const typename Access::Point& point)
{
  typename Access::Point corners[Access::Corners];
  access.corners(cell, corners);
  return withRank(keyOf(access, cell), moveRank(corners, point));
}

/// Chooses one of the cells that contain a point. Their keys are computed only if there are
/// several.
template <typename Access>
class Choice
{
public:
  using Point = typename Access::Point;

  Choice(const Access& access, const std::int64_t* cellIds, const Point& point)
    : Cells(access)
    , CellIds(cellIds)
    , Position(point)
  {
  }

  void offer(std::int64_t cell)
  {
    Point corners[Access::Corners];
    this->Cells.corners(cell, corners);
    if (sideOf(corners, this->Position) == Side::Outside)
    {
      return;
    }
    if (this->Cell >= 0)
    {
      if (!this->IsRanked)
      {
        this->rank(this->Cell);
      }
      this->IsRanked = true;
      const auto before = std::make_pair(this->Best, this->Cell);
      this->rank(cell);
      if (before.first < this->Best)
      {
        std::tie(this->Best, this->Cell) = before;
        return;
      }
    }
    this->Cell = cell;
  }

  std::int64_t cell() const { return this->Cell; }

private:
  using Rank = std::pair<CellKey, std::int64_t>;

  void rank(std::int64_t cell)
  {
    this->Best = { keyOfCell(this->Cells, cell, this->Position),
      this->CellIds ? this->CellIds[cell] : cell };
  }

  const Access& Cells;
  const std::int64_t* CellIds;
  Point Position;
  std::int64_t Cell = -1;
  Rank Best{};
  bool IsRanked = false;
};

/// The weights of a cell's corners at a point. They are evaluated with the corners in lexicographic
/// order, so that they do not depend on their order in the cell.
template <typename Access>
CellLocation weighed(const Access& access, std::int64_t cell, const typename Access::Point& point)
{
  constexpr int D = Access::Dimension;
  CellLocation location;
  location.Cell = cell;
  typename Access::Point corners[D + 1];
  access.corners(cell, corners);
  int order[D + 1];
  std::iota(order, order + D + 1, 0);
  for (int i = 1; i <= D; ++i)
  {
    for (int k = i; k > 0 && lexicographicLess(corners[order[k]], corners[order[k - 1]]); --k)
    {
      std::swap(order[k], order[k - 1]);
    }
  }
  const auto& first = corners[order[0]];
  double edges[D][D];
  double offset[D];
  for (int axis = 0; axis < D; ++axis)
  {
    for (int i = 0; i < D; ++i)
    {
      edges[i][axis] = corners[order[i + 1]][axis] - first[axis];
    }
    offset[axis] = point[axis] - first[axis];
  }
  double weights[D];
  thinWeights(edges, offset, weights);
  location.Weights[order[0]] = 1;
  for (int i = 0; i < D; ++i)
  {
    location.Weights[order[i + 1]] = weights[i];
    location.Weights[order[0]] -= weights[i];
  }
  return location;
}

/// Empty for hidden cells and cells with an infinite or NaN coordinate.
template <typename Access>
auto boxOfCell(const Access& access, const SimplexMesh& mesh, std::int64_t cell)
{
  using CellBox = Box<Access::Dimension>;
  CellBox box = CellBox::empty();
  bool isUsable = !mesh.Hidden || !mesh.Hidden[cell];
  for (int i = 0; i < Access::Corners; ++i)
  {
    const auto corner = access.coordinates(access.ids(cell)[i]);
    isUsable = isUsable && isFinite(corner);
    box.extend(corner);
  }
  return isUsable ? box : CellBox::empty();
}

} // namespace tipp

#endif
