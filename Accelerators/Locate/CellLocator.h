// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellLocator_h
#define tippCellLocator_h

#include "Locate/BoxTree.h"
#include "Locate/Locations.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Geometry.h"
#include "Resample/CellKey.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

namespace tipp
{

/// A triangle in the plane, or a tetrahedron, and its distance from a point outside of it.
struct VTKTIPPACCELERATORS_EXPORT NearCell
{
  std::int64_t Id = -1; ///< global; -1: none yet
  int Dimension = 2;
  Point3 Corners[4] = {}; ///< triangles use three, with z = 0
  Point3 At = {};         ///< the nearest location of the cell, rounded
  /// Bounds of the distance; the upper one is infinite if it is not known.
  double Low = 0;
  double High = std::numeric_limits<double>::infinity();

  /// Sets At and the bounds for a point outside of the cell.
  void measure(const Point3& from);
  /// Whether this cell is nearer to `from` than another, or as near with the lower id. Both must
  /// have been measured from that point. Decided exactly.
  bool isBetterThan(const NearCell& other, const Point3& from) const;
  /// Returns the distance from `from`. The distance and At become accurate to a few roundings.
  double distance(const Point3& from);
};

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

  /// A walk that takes more steps than this is given up, and the tree finds the point's cell. A
  /// walk starts at the nearest of a sample of the cells, so ordinary meshes need a few dozen
  /// steps.
  static constexpr std::int64_t MostSteps = 4096;
  static constexpr std::uint32_t None = ~std::uint32_t(0);
  static constexpr std::uint32_t Turned = 0x80000000u;

  /// For each corner of a triangle, the neighbour across the opposite edge, as 3 * neighbour + the
  /// neighbour's corner opposite to that edge; the highest bit is set if the neighbour is
  /// clockwise. Empty if walks are not possible.
  std::vector<std::uint32_t> Neighbors;
  bool IsConvex = false; ///< the border is a single convex loop
  Box2 Bounds = Box2::empty();
  std::vector<std::uint64_t> SeedCodes; ///< Morton codes, ascending
  std::vector<std::uint32_t> Seeds;     ///< triangles; the highest bit is set for clockwise ones
};

/// Finds the cells of a SimplexMesh that contain given points, by the same rule as resampling. A
/// point's cell is the one that contains it after a symbolic move by (e, e^2, e^3) with
/// infinitesimal e. At the mesh's border, it is the cell into which the first of the mirrored moves
/// leads. Among overlapping cells, it is the one with the lowest CellKey. So each point has one
/// cell, whatever the order of cells and points. Exact for all finite coordinates. Degenerate
/// cells, hidden cells and cells with infinite or NaN coordinates contain no point.
///
/// Triangles that do not overlap are found by walks (CellWalk) from the previous point. Points that
/// walks do not find, and other meshes, are searched with a tree of the cells' boxes, which is
/// built when it is first needed.
class VTKTIPPACCELERATORS_EXPORT CellLocator
{
public:
  /// Triangles use points' two coordinates along SimplexMesh::Axes. `mesh` and its arrays, and
  /// `cellIds`, must outlive this. `cellIds` (one global id per cell; may be null) distinguishes
  /// copies of a cell: the lowest id wins. `threads` must be at least 1.
  CellLocator(const SimplexMesh& mesh, const std::int64_t* cellIds, int threads);

  /// For a point outside of all cells: replaces `best` if a cell of the mesh is nearer to the
  /// point, or as near with a lower id. Several threads may call it.
  void findNearest(const Point3& point, NearCell& best) const;

  /// Upper bound of a locator's memory, in bytes.
  static std::int64_t bytesFor(std::int64_t cells, int dimension)
  {
    const std::int64_t tree = cells * (dimension == 2 ? 23 : 32) + 1024;
    return dimension == 2 ? CellWalk::bytesFor(cells) + std::max(tree, CellWalk::bytesToMake(cells))
                          : tree;
  }

private:
  template <int D>
  const BoxTree<D>& tree() const;
  template <typename Access>
  void findInOrder(const Access& access, const AskedPoints& points, const std::int32_t* order,
    std::int64_t count, const TakeLocations& take) const;
  template <typename Access>
  bool areNear(const Access& access, const AskedPoints& points) const;
  template <typename Access>
  std::vector<std::int64_t> walkAll(
    const Access& access, const AskedPoints& points, int threads, const TakeLocations& take) const;
  template <typename Access>
  void locateAll(
    const Access& access, const AskedPoints& points, int threads, const TakeLocations& take) const;
  friend VTKTIPPACCELERATORS_EXPORT void locatePoints(const SimplexMesh& mesh,
    const std::int64_t* cellIds, const CellLocator* locator, const AskedPoints& points, int threads,
    const TakeLocations& take);

  SimplexMesh Mesh;
  const std::int64_t* CellIds;
  int Threads;
  CellWalk Walk;
  mutable std::once_flag Making; ///< guards building the tree
  mutable std::variant<BoxTree<2>, BoxTree<3>> Tree;
  mutable std::atomic<int> Passes{ 0 }; ///< passes made instead of building the tree
};

/// Calls `take` with the locations of the asked points that lie in a cell, from several threads, in
/// any order. If `locator`, which must be one of `mesh`, is null, each cell searches a tree of the
/// points instead: for few points that is faster than building a locator. At most 2^31 - 1 points.
/// The locations do not depend on the number of threads or on whether there is a locator.
VTKTIPPACCELERATORS_EXPORT void locatePoints(const SimplexMesh& mesh, const std::int64_t* cellIds,
  const CellLocator* locator, const AskedPoints& points, int threads, const TakeLocations& take);

/// Calls `take` with the locations of the asked points that lie in a cell, from several threads, in
/// any order. Makes one pass over the cells, each of which looks up its points in a grid. It needs
/// no locator and is the fastest way if there are about as many points as cells.
/// Returns false if the pass is too slow for this input, for example because of many thin cells or
/// many points on edges, or if cells overlap; `take` may then have received only some points, and
/// wrong locations. Takes about 30 bytes per point. Exact; at most 2^31 - 1 points.
VTKTIPPACCELERATORS_EXPORT bool locateInOnePass(const SimplexMesh& mesh,
  const std::int64_t* cellIds, const AskedPoints& points, int threads, const TakeLocations& take);

/// The key of a cell that contains a point. If several cells contain it, for example on different
/// ranks, the cell with the lowest key, then the lowest id, is chosen.
VTKTIPPACCELERATORS_EXPORT CellKey keyAt(
  const SimplexMesh& mesh, std::int64_t cell, const Point3& point);

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
  if (isFirst)
  {
    this->jump(point, at);
  }
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
  if (exit == 0)
  {
    std::swap(b, c);
  }
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
