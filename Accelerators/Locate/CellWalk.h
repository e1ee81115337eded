// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellWalk_h
#define tippCellWalk_h

#include "Locate/MortonOrder.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Points.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// Whether a point is to the right of the line from a to b, two different points, after a move by
/// (e, e^2) for all e small enough. Exact.
inline bool isBeyondExactly(Point2 a, Point2 b, Point2 point)
{
  const int side = orientation(a, b, point);
  return side != 0 ? side < 0 : a.y != b.y ? a.y < b.y : b.x < a.x;
}

/// Finds the triangle that contains a point by walking across common edges (Devillers, Pion and
/// Teillaud, Walking in a Triangulation, 2002).
///
/// A walk finds one triangle. It is the only one that contains the point if no triangles overlap.
/// To establish that, it is enough to check boundary edges (those of a single triangle): the number
/// of triangles that cover a point is the winding number of the boundary edges around it, so it
/// changes only at such an edge. If triangles overlapped, some triangle would meet a boundary edge
/// of another at more than common corners. Each boundary edge is tested for that, exactly.
class VTKTIPPACCELERATORS_EXPORT CellWalk
{
public:
  /// The mesh and its arrays must outlive this. Hidden and degenerate triangles and those with
  /// non-finite coordinates are excluded.
  CellWalk(const SimplexMesh& mesh, int threads);

  /// Whether walks are possible: no triangles overlap, and there are at most 700 million.
  bool isUsable() const { return !this->Neighbors.empty(); }

  /// The state of a walk: its current triangle, its orientation, and how many triangles were
  /// passed.
  struct Position
  {
    std::int64_t Cell = -1;
    bool IsClockwise = false; ///< orientation of Cell
    std::int64_t Steps = 0;
  };

  enum class Outcome
  {
    Found,
    Outside,
    Unknown ///< it may be outside, in a hole, on the border, or far away
  };

  /// Walks to the triangle that contains a finite point after a move by (e, e^2), and sets `at` to
  /// it. Starts at `at` unless that is far from the point.
  template <typename Access>
  Outcome walk(const Access& access, Point2 point, Position& at) const;

  /// Memory in bytes: what the object keeps, and what the constructor needs temporarily in
  /// addition.
  static std::int64_t bytesFor(std::int64_t cells) { return cells * 13 + 1024; }
  static std::int64_t bytesToMake(std::int64_t cells) { return cells * 28; }

private:
  template <typename Access>
  class Builder;

  /// Sets `at` to a triangle near a point.
  void jump(Point2 point, Position& at) const;

  static constexpr std::int64_t MostSteps = 4096;
  static constexpr std::uint32_t None = ~std::uint32_t(0);
  static constexpr std::uint32_t Turned = 0x80000000u;

  /// For each corner of a triangle, the neighbour across the opposite edge, as 3 * neighbour + the
  /// neighbour's corner opposite to that edge; the highest bit is set if the neighbour is
  /// clockwise. Empty if walks are not possible.
  std::vector<std::uint32_t> Neighbors;
  bool IsConvex = false; ///< the border is a single convex loop
  Box<2> Bounds = Box<2>::empty();
  std::vector<std::uint64_t> SeedCodes; ///< Morton codes, ascending
  std::vector<std::uint32_t> Seeds;     ///< triangles; the highest bit is set for clockwise ones
};

template <typename Access>
CellWalk::Outcome CellWalk::walk(const Access& access, Point2 point, Position& at) const
{
  struct Corner
  {
    Point2 At;
    Point2 Offset; ///< the point minus a
  };
  const auto corner = [&](std::int64_t cell, int i)
  {
    const auto [x, y] = access.coordinates(access.ids(cell)[i]);
    return Corner{ { x, y }, { x - point.x, y - point.y } };
  };
  const auto isBeyond = [&](const Corner& from, const Corner& to)
  {
    // The error bound of orientation(), which starts from the same differences.
    constexpr double relative = 3.3306690738754716e-16;
    constexpr double absolute = 1e-300;
    const double left = from.Offset.x * to.Offset.y;
    const double right = from.Offset.y * to.Offset.x;
    const double determinant = left - right;
    const double bound = relative * (std::fabs(left) + std::fabs(right)) + absolute;
    return std::fabs(determinant) > bound ? determinant < 0
                                          : isBeyondExactly(from.At, to.At, point);
  };
  Corner a{};
  Corner b{};
  Corner c{};
  int second = 1; // (index of b - index of a) modulo 3; a, b, c are counter-clockwise
  const auto start = [&]
  {
    second = at.IsClockwise ? 2 : 1;
    a = corner(at.Cell, 0);
    b = corner(at.Cell, second);
    c = corner(at.Cell, 3 - second);
  };
  const auto length = [](Point2 p) { return std::fabs(p.x) + std::fabs(p.y); };
  const bool isFirst = at.Cell < 0;
  isFirst ? this->jump(point, at) : void();
  start();
  if (!isFirst && !(length(a.Offset) <= 16 * std::max(length(b.At - a.At), length(c.At - a.At))))
  {
    this->jump(point, at);
    start();
  }
  constexpr int turned[5] = { 0, 1, 2, 0, 1 };
  int apex = 0; // the corner that is a
  // The corner opposite to the edge to cross next; -1: not known yet.
  int exit = isBeyond(b, c) ? 0 : -1;
  exit == 0 ? std::swap(b, c) : void();
  for (std::int64_t step = 0; step < MostSteps; ++step)
  {
    if (exit < 0)
    {
      const bool isBeyondAB = isBeyond(a, b);
      const bool isBeyondCA = isBeyond(c, a);
      if (!isBeyondAB && !isBeyondCA)
      {
        return Outcome::Found;
      }
      // Alternates: always preferring the same edge could walk in circles.
      const bool acrossAB = isBeyondAB && (!isBeyondCA || step % 2 == 0);
      exit = turned[apex + (acrossAB ? 3 - second : second)];
      (acrossAB ? c : b) = a; // seen from beyond, bc is the common edge
    }
    const std::uint32_t across = this->Neighbors[std::size_t(3 * at.Cell + exit)];
    if (across == None)
    {
      return this->IsConvex && orientation(b.At, c.At, point) > 0 ? Outcome::Outside
                                                                  : Outcome::Unknown;
    }
    at.IsClockwise = (across & Turned) != 0;
    at.Cell = (across & ~Turned) / 3;
    second = at.IsClockwise ? 2 : 1;
    apex = int((across & ~Turned) % 3);
    a = corner(at.Cell, apex);
    exit = -1;
    ++at.Steps;
  }
  return Outcome::Unknown;
}

} // namespace tipp

#endif
