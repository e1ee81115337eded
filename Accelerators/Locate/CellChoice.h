// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellChoice_h
#define tippCellChoice_h

#include "Locate/CellLocation.h"
#include "Locate/MortonOrder.h"
#include "Predicates/ExactPredicates.h"
#include "Resample/BorderClaims.h"
#include "Resample/Claims.h"
#include "Resample/SampleBlock.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace tipp
{

/// Whether a closed, non-degenerate cell contains a point. Exact.
inline bool contains(const Point2 (&corners)[3], Point2 p)
{
  const int first = orientation(corners[0], corners[1], p);
  const int second = orientation(corners[1], corners[2], p);
  if (first * second < 0)
  {
    return false;
  }
  const int third = orientation(corners[2], corners[0], p);
  const int sum = first + second + third;
  if (sum == 3 || sum == -3)
  {
    return true;
  }
  return first * third >= 0 && second * third >= 0 &&
    orientation(corners[0], corners[1], corners[2]) != 0;
}

inline bool contains(const Point3 (&corners)[4], const Point3& p)
{
  const auto& [a, b, c, d] = corners;
  const int side = orientation3(a, b, c, d);
  return side != 0 && side * orientation3(a, b, c, p) >= 0 &&
    side * orientation3(a, c, d, p) >= 0 && side * orientation3(a, d, b, p) >= 0 &&
    side * orientation3(b, d, c, p) >= 0;
}

/// The coordinates of a point in the mesh's dimension.
template <int D>
auto flattened(const SimplexMesh& mesh, const Point3& p)
{
  if constexpr (D == 2)
  {
    const double coordinates[3] = { p.x, p.y, p.z };
    return Point2{ coordinates[mesh.Axes[0]], coordinates[mesh.Axes[1]] };
  }
  else
  {
    return p;
  }
}

inline std::array<double, 2> arrayOf(Point2 p)
{
  return { p.x, p.y };
}
inline std::array<double, 3> arrayOf(const Point3& p)
{
  return { p.x, p.y, p.z };
}

template <typename Access, typename Point>
CellKey keyOfCell(const Access& access, std::int64_t cell, const Point& point)
{
  Point corners[Access::Corners];
  access.corners(cell, corners);
  return withRank(keyOf(access, cell), moveRank(corners, point));
}

/// Chooses one of the cells that contain a point. Their keys are computed only if there are
/// several.
template <typename Access, typename Point>
class Choice
{
public:
  Choice(const Access& access, const std::int64_t* cellIds, const Point& point)
    : Cells(access)
    , CellIds(cellIds)
    , Of(point)
  {
  }

  void offer(std::int64_t cell)
  {
    Point corners[Access::Corners];
    this->Cells.corners(cell, corners);
    if (!contains(corners, this->Of))
    {
      return;
    }
    if (this->Cell >= 0)
    {
      this->IsRanked ? void() : this->rank(this->Cell);
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
    this->Best = { keyOfCell(this->Cells, cell, this->Of),
      this->CellIds ? this->CellIds[cell] : cell };
  }

  const Access& Cells;
  const std::int64_t* CellIds;
  Point Of;
  std::int64_t Cell = -1;
  Rank Best{};
  bool IsRanked = false;
};

/// ThinWeights<2>, bit for bit, in fewer instructions.
inline void weighTriangle(
  const double (&edges)[2][2], const double (&offset)[2], double (&weights)[2])
{
  int row = 0;
  int column = 0;
  for (int i = 1; i < 4; ++i)
  {
    const bool isLarger = std::fabs(edges[i % 2][i / 2]) > std::fabs(edges[column][row]);
    row = isLarger ? i / 2 : row;
    column = isLarger ? i % 2 : column;
  }
  constexpr double rounding = 4.4408920985006262e-16;
  const double pivot = edges[column][row];
  const double beside = edges[1 - column][row];
  const double first = std::fabs(pivot);
  const double ofPivot = first > rounding * first ? 1 / pivot : 0;
  const double factor = edges[column][1 - row] * ofPivot;
  const double rest = edges[1 - column][1 - row] - factor * beside;
  const double ofRest = std::fabs(rest) > rounding * first ? 1 / rest : 0;
  const double other = (offset[1 - row] - factor * offset[row]) * ofRest;
  weights[1 - column] = other;
  weights[column] = (offset[row] - beside * other) * ofPivot;
}

/// The weights of a cell's corners at a point. They are evaluated with the corners in lexicographic
/// order, so that they do not depend on their order in the cell.
template <typename Access, typename Point>
CellLocation weighed(const Access& access, std::int64_t cell, const Point& point)
{
  constexpr int D = Access::Dimension;
  CellLocation location;
  location.Cell = cell;
  Point corners[D + 1];
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
  const auto first = arrayOf(corners[order[0]]);
  double edges[D][D];
  double offset[D];
  for (int axis = 0; axis < D; ++axis)
  {
    for (int i = 0; i < D; ++i)
    {
      edges[i][axis] = arrayOf(corners[order[i + 1]])[std::size_t(axis)] - first[std::size_t(axis)];
    }
    offset[axis] = arrayOf(point)[std::size_t(axis)] - first[std::size_t(axis)];
  }
  double weights[D];
  if constexpr (D == 2)
  {
    weighTriangle(edges, offset, weights);
  }
  else
  {
    ThinWeights<D>(edges).solve(offset, weights);
  }
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
  constexpr int D = Access::Dimension;
  Box<D> box = Box<D>::empty();
  bool isUsable = !mesh.Hidden || !mesh.Hidden[cell];
  for (int i = 0; i < Access::Corners; ++i)
  {
    double corner[D];
    access.coordinates(access.ids(cell)[i], corner);
    for (int axis = 0; axis < D; ++axis)
    {
      isUsable = isUsable && std::isfinite(corner[axis]);
      box.Low[axis] = std::min(box.Low[axis], corner[axis]);
      box.High[axis] = std::max(box.High[axis], corner[axis]);
    }
  }
  return isUsable ? box : Box<D>::empty();
}

} // namespace tipp

#endif
