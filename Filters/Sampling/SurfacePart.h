// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurfacePart_h
#define tippSurfacePart_h

#include "Parallel/BoundsOf.h"
#include "Predicates/Geometry.h"
#include "Resample/SimplexMesh.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// An array of a surface.
struct SurfaceArray
{
  std::string Name;
  int Components = 1;
  bool OfCells = true; ///< otherwise of points
};

/// A surface, or a part of one, as triangles. Other cells are cut into triangles.
struct SurfacePart
{
  SimplexMesh Mesh; ///< cells with a corner that is not finite are hidden
  /// The cell of each triangle; null: the same index.
  const std::int64_t* Parents = nullptr;
  std::int64_t Cells = 0;           ///< their number before any was cut
  std::int64_t NotFinite = 0;       ///< cells left out because a corner is not finite
  std::vector<SurfaceArray> Arrays; ///< of numbers: those of cells, then those of points
  /// Returns the values of one of Arrays as doubles, which stay valid as long as this object.
  std::function<const double*(const SurfaceArray& array)> Values;
  std::shared_ptr<const void> Owner; ///< owns the memory of all that
};

/// The bounding box of the finite points of a surface.
inline Box3 finiteBounds(const SimplexMesh& mesh, int threads)
{
  Box3 bounds = Box3::empty();
  if (mesh.PointCount > 0)
  {
    withAccess(mesh,
      [&](const auto& access)
      {
        bounds = boundsOf<3>(mesh.PointCount, threads,
          [&access](std::int64_t id)
          {
            const Point3 p = access.point(id);
            return Box3{ p, p };
          });
      });
  }
  return bounds.isEmpty() ? Box3{} : bounds;
}

} // namespace tipp

#endif
