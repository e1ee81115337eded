// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellLocator_h
#define tippCellLocator_h

#include "Locate/BoxTree.h"
#include "Locate/CellLocation.h"
#include "Locate/CellWalk.h"
#include "Locate/NearCell.h"
#include "Predicates/Points.h"
#include "Resample/Claims.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <variant>
#include <vector>

namespace tipp
{

/// Points to locate: points[asked[i]] for all i < count, or points[i] if `asked` is null.
struct AskedPoints
{
  const Point3* Points = nullptr;
  const std::int64_t* Asked = nullptr;
  std::int64_t Count = 0;

  std::int64_t index(std::int64_t i) const { return this->Asked ? this->Asked[i] : i; }
  const Point3& at(std::int64_t i) const { return this->Points[this->index(i)]; }
};

/// Takes the indices of some points, in the array of all points, and their locations.
using TakeLocations =
  std::function<void(const std::int64_t* points, const CellLocation* at, std::int64_t count)>;

/// Finds the cells of a SimplexMesh that hold given points, by the rule of the resampling: the cell
/// that contains the point after a move by (e, e^2, e^3), for all e small enough; at the mesh's
/// border the first mirrored move that leads into a cell decides; of cells that overlap the one
/// with the lowest CellKey. So each point has one cell, whatever the order of cells and points.
/// Exact for all finite coordinates. Cells without an area or volume, hidden cells, and cells with
/// coordinates that are infinite or NaN hold nothing.
///
/// Triangles are found by walks (CellWalk) from the point before, where they do not overlap. What
/// walks do not find, and all else, is searched in a tree of the cells' boxes, which is made when
/// it is first needed.
class VTKTIPPACCELERATORS_EXPORT CellLocator
{
public:
  /// `mesh` and its arrays must outlive this. `cellIds`, may be null, tells equal copies of a cell
  /// apart: the lowest id counts. `threads` is at least 1.
  CellLocator(const SimplexMesh& mesh, const std::int64_t* cellIds, int threads);

  /// Triangles use the two coordinates along SimplexMesh::Axes. Several threads may call it.
  CellLocation locate(const Point3& point) const;

  /// Replaces `best` if a cell is nearer to a point that no cell of the mesh holds, or as near with
  /// a lower id. Several threads may call it.
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
  template <typename Access, typename Point>
  std::int64_t find(const Access& access, const Point& point) const;
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
  mutable std::once_flag Making; ///< of the tree
  mutable std::variant<BoxTree<2>, BoxTree<3>> Tree;
  mutable std::atomic<int> Passes{ 0 }; ///< over all cells, which stood in for the tree
};

/// Calls `take` for the asked points that a cell holds, from several threads, in any order. Uses a
/// locator of the mesh or, if that is null, one of the points, which each cell searches: for few
/// points that is faster than making a locator. At most 2^31 - 1 points. The locations are the same
/// for any number of threads and with or without a locator.
VTKTIPPACCELERATORS_EXPORT void locatePoints(const SimplexMesh& mesh, const std::int64_t* cellIds,
  const CellLocator* locator, const AskedPoints& points, int threads, const TakeLocations& take);

/// The key of a cell that holds a point: of several cells, as of different ranks, the one of lowest
/// key, then of lowest id, answers the point.
VTKTIPPACCELERATORS_EXPORT CellKey keyAt(
  const SimplexMesh& mesh, std::int64_t cell, const Point3& point);

} // namespace tipp

#endif
