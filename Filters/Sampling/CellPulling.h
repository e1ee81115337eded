// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellPulling_h
#define tippCellPulling_h

#include "Predicates/Point3.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Cuts convex cells into simplices by "pulling" the lexicographically least corner: every face is
/// triangulated from its own least corner, so that both cells at a face agree. As in Dompierre,
/// Labbe, Vallet, Camarero, How to Subdivide Pyramids, Prisms and Hexahedra into Tetrahedra, 1999,
/// with coordinates instead of vertex numbers.
class CellPulling
{
public:
  /// A corner of a cell: its coordinates and its point id.
  struct Corner
  {
    Point3 Place;
    std::int64_t Id;
  };
  using Face = std::vector<int>; ///< corners in order around the face

  /// The faces of VTK_HEXAHEDRON, VTK_VOXEL, VTK_WEDGE or VTK_PYRAMID; none for other types.
  static const std::vector<Face>& facesOf(int cellType);

  /// Appends triangles to `ids`, three point ids each. A quad with a reflex corner is cut along the
  /// diagonal inside; other polygons must be convex.
  static void polygon(const std::vector<Corner>& corners, std::vector<std::int64_t>& ids);
  /// Appends tetrahedra to `ids`, four point ids each.
  static void polyhedron(const std::vector<Corner>& corners, const std::vector<Face>& faces,
    std::vector<std::int64_t>& ids);
};

} // namespace tipp

#endif
