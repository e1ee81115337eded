// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/PieceSource.h"

#include "Parallel/Poll.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <array>
#include <limits>

namespace tipp
{
namespace
{

constexpr std::uint8_t insideRange =
  0x80; ///< marks points inside the range, which have no side bits

bool boxesMeet(const Box3& a, const Box3& b)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (a.Min[axis] > b.Max[axis] || b.Min[axis] > a.Max[axis])
    {
      return false;
    }
  }
  return true;
}

std::array<double, 3> pointOf(const Piece& piece, std::int64_t point)
{
  std::array<double, 3> xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t at = 3 * std::size_t(point) + axis;
    xyz[axis] = piece.PointType == Scalar::Float32 ? double(piece.Coordinates.as<float>()[at])
                                                   : piece.Coordinates.as<double>()[at];
  }
  return xyz;
}

} // namespace

Box3 boxOf(const PartitionedMesh& mesh, const Bounds& bounds)
{
  Box3 box;
  for (std::size_t axis = 0; axis < (mesh.CellSize == 3 ? 2 : 3); ++axis)
  {
    // Infinite bounds become the largest double, because predicates need finite numbers.
    constexpr double most = std::numeric_limits<double>::max();
    box.Min[axis] = std::clamp(bounds[2 * axis], -most, most);
    box.Max[axis] = std::clamp(bounds[2 * axis + 1], -most, most);
  }
  return box;
}

RangeFilter::RangeFilter(const PartitionedMesh& mesh, const Bounds& range)
  : Mesh(mesh)
  , Range(boxOf(mesh, range))
{
  // Clip to the domain, outside of which there are no cells, so that the predicates get numbers of
  // the mesh's own magnitude.
  const Box3 domain = boxOf(mesh, mesh.Domain);
  const bool apart = !boxesMeet(this->Range, domain);
  for (std::size_t axis = 0; axis < 3 && !apart; ++axis)
  {
    this->Range.Min[axis] = std::max(this->Range.Min[axis], domain.Min[axis]);
    this->Range.Max[axis] = std::min(this->Range.Max[axis], domain.Max[axis]);
  }
  for (std::size_t i = 0; i < mesh.Pieces.size() && !apart; ++i)
  {
    if (boxesMeet(boxOf(mesh, mesh.Pieces[i].Box), this->Range))
    {
      this->Open.push_back(i);
    }
  }
}

bool RangeFilter::meets(const Piece& piece, std::int64_t cell, const Box3& box) const
{
  const auto corner = [&](int i)
  {
    const std::array<double, 3> p = pointOf(piece, piece.corner(cell, i));
    return Point3{ p[0], p[1], p[2] };
  };
  const Point3 a = corner(0);
  const Point3 b = corner(1);
  const Point3 c = corner(2);
  return piece.CellSize == 3 ? triangleMeetsBox({ a.x, a.y }, { b.x, b.y }, { c.x, c.y }, box)
                             : tetrahedronMeetsBox(a, b, c, corner(3), box);
}

bool RangeFilter::isLowerPieceMet(const Piece& piece, std::int64_t cell, std::size_t number) const
{
  for (const std::size_t other : this->Open)
  {
    if (other >= number)
    {
      return false;
    }
    if (this->meets(piece, cell, boxOf(this->Mesh, this->Mesh.Pieces[other].Box)))
    {
      return true;
    }
  }
  return false;
}

void RangeFilter::setPointGhosts(Piece& piece, std::size_t number) const
{
  auto* const ghosts = piece.PointGhosts.as<std::uint8_t>();
  for (std::int64_t point = 0; point < piece.Points; ++point)
  {
    if (ghosts[point] == 0)
    {
      continue;
    }
    std::array<double, 3> xyz = pointOf(piece, point);
    xyz[2] = piece.CellSize == 3 ? 0 : xyz[2];
    const Box3 at{ xyz, xyz };
    const auto owner = std::find_if(this->Open.begin(), this->Open.end(),
      [&](std::size_t other)
      { return boxesMeet(at, boxOf(this->Mesh, this->Mesh.Pieces[other].Box)); });
    ghosts[point] = owner != this->Open.end() && *owner != number ? 1 : 0;
  }
}

std::vector<std::uint8_t> RangeFilter::sidesOfPoints(const Piece& piece) const
{
  const std::size_t axes = piece.CellSize == 3 ? 2 : 3;
  std::vector<std::uint8_t> sides(std::size_t(piece.Points));
  for (std::int64_t point = 0; point < piece.Points; ++point)
  {
    const std::array<double, 3> xyz = pointOf(piece, point);
    int beyond = 0;
    bool within = true; // false for NaN
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      beyond |= int(xyz[axis] < this->Range.Min[axis]) << (2 * axis);
      beyond |= int(xyz[axis] > this->Range.Max[axis]) << (2 * axis + 1);
      within = within && xyz[axis] >= this->Range.Min[axis] && xyz[axis] <= this->Range.Max[axis];
    }
    sides[std::size_t(point)] = std::uint8_t(within ? insideRange : beyond);
  }
  return sides;
}

bool RangeFilter::meetsRange(
  const Piece& piece, std::int64_t cell, const std::vector<std::uint8_t>& sides) const
{
  int common = 0xff;
  bool inside = false;
  for (int corner = 0; corner < piece.CellSize; ++corner)
  {
    const int beyond = sides[std::size_t(piece.corner(cell, corner))];
    common &= beyond;
    inside = inside || beyond == insideRange;
  }
  return inside || (common == 0 && this->meets(piece, cell, this->Range));
}

Piece RangeFilter::apply(const Piece& piece, std::size_t number, bool borrowed) const
{
  const std::vector<std::uint8_t> sides = this->sidesOfPoints(piece);
  std::vector<CellOfPiece> owned;
  std::vector<CellOfPiece> ghosts;
  for (std::int64_t cell = 0; cell < piece.Cells; ++cell)
  {
    pollAt(cell);
    if (!this->meetsRange(piece, cell, sides))
    {
      continue;
    }
    if (cell < piece.OwnedCells || !this->isLowerPieceMet(piece, cell, number))
    {
      owned.push_back({ 0, cell });
    }
    else if (borrowed)
    {
      ghosts.push_back({ 0, cell });
    }
  }
  Piece kept = gatherCells({ &piece }, owned, ghosts, false);
  this->setPointGhosts(kept, number);
  return kept;
}

} // namespace tipp
