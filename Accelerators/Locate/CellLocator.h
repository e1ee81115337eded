// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellLocator_h
#define tippCellLocator_h

#include "Locate/BoxTree.h"
#include "Locate/CellLocation.h"
#include "Locate/NearCell.h"
#include "Predicates/Points.h"
#include "Resample/Claims.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <functional>
#include <variant>

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

/// Takes the index of a point, in the array of all points, and its location.
using TakeLocation = std::function<void(std::int64_t, const CellLocation&)>;

/// Finds the cells of a SimplexMesh that hold given points, by the rule of the resampling: the cell
/// that contains the point after a move by (e, e^2, e^3), for all e small enough; at the mesh's
/// border the first mirrored move that leads into a cell decides; of cells that overlap the one
/// with the lowest CellKey. So each point has one cell, whatever the order of cells and points.
/// Exact for all finite coordinates. Cells without an area or volume, hidden cells, and cells with
/// coordinates that are infinite or NaN hold nothing.
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

  /// What a locator of so many cells takes.
  static std::int64_t bytesFor(std::int64_t cells, int dimension)
  {
    return cells * (dimension == 2 ? 23 : 32) + 1024;
  }

private:
  template <typename Access, typename Point>
  std::int64_t find(const Access& access, const Point& point) const;
  template <typename Access>
  void findInOrder(const Access& access, const AskedPoints& points, const std::int32_t* order,
    std::int64_t count, const TakeLocation& take) const;
  friend VTKTIPPACCELERATORS_EXPORT void locatePoints(const SimplexMesh& mesh,
    const std::int64_t* cellIds, const CellLocator* locator, const AskedPoints& points, int threads,
    const TakeLocation& take);

  SimplexMesh Mesh;
  const std::int64_t* CellIds;
  std::variant<BoxTree<2>, BoxTree<3>> Tree;
};

/// Calls `take` for each asked point that a cell holds, from several threads, in any order. Uses a
/// locator of the mesh or, if that is null, one of the points, which each cell searches: for few
/// points that is faster than making a locator. At most 2^31 - 1 points. The locations are the same
/// for any number of threads and with or without a locator.
VTKTIPPACCELERATORS_EXPORT void locatePoints(const SimplexMesh& mesh, const std::int64_t* cellIds,
  const CellLocator* locator, const AskedPoints& points, int threads, const TakeLocation& take);

/// The key of a cell that holds a point: of several cells, as of different ranks, the one of lowest
/// key, then of lowest id, answers the point.
VTKTIPPACCELERATORS_EXPORT CellKey keyAt(
  const SimplexMesh& mesh, std::int64_t cell, const Point3& point);

} // namespace tipp

#endif
