// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellLocator_h
#define tippCellLocator_h

#include "Locate/BoxTree.h"
#include "Locate/CellLocation.h"
#include "Locate/CellWalk.h"
#include "Predicates/Points.h"
#include "Resample/Claims.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
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

/// Points to locate: points[asked[i]] for all i < count, or points[i] if `asked` is null.
struct AskedPoints
{
  const Point3* Points = nullptr;
  const std::int64_t* Asked = nullptr;
  std::int64_t Count = 0; ///< number of points to locate

  std::int64_t index(std::int64_t i) const { return this->Asked ? this->Asked[i] : i; }
  const Point3& at(std::int64_t i) const { return this->Points[this->index(i)]; }
};

/// Receives some of the locations: `count` indices into the array of all points, and the points'
/// locations. The arrays are valid during the call only.
using TakeLocations =
  std::function<void(const std::int64_t* points, const CellLocation* at, std::int64_t count)>;

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
  /// `mesh` and its arrays, and `cellIds`, must outlive this. `cellIds` (one global id per cell;
  /// may be null) distinguishes copies of a cell: the lowest id wins. `threads` must be at least 1.
  CellLocator(const SimplexMesh& mesh, const std::int64_t* cellIds, int threads);

  /// Finds the cell of a point. Triangles use its two coordinates along SimplexMesh::Axes. Several
  /// threads may call it.
  CellLocation locate(const Point3& point) const;

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
  std::int64_t find(const Access& access, const typename Access::Point& point) const;
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

/// The key of a cell that contains a point. If several cells contain it, for example on different
/// ranks, the cell with the lowest key, then the lowest id, is chosen.
VTKTIPPACCELERATORS_EXPORT CellKey keyAt(
  const SimplexMesh& mesh, std::int64_t cell, const Point3& point);

} // namespace tipp

#endif
