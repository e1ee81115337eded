// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVertexRegions_h
#define tippVertexRegions_h

#include "Kernel/TetrahedronMesh.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Divides space into regions of about equal numbers of vertices, and numbers them from 0: a tree
/// of cuts, each across the longest side of its vertices' bounding box.
class VTKTIPPFILTERS_EXPORT VertexRegions
{
public:
  using Index = TetrahedronMesh::Index;
  static constexpr int Most = 255;
  static constexpr std::uint8_t None = 255; ///< no region's number

  /// `vertices` are indices into `points`, both of which are read only here. At most Most regions;
  /// some may have no vertices.
  VertexRegions(const Point3* points, const std::vector<Index>& vertices, int regions);

  /// Returns the region of a point.
  std::uint8_t of(const Point3& p) const
  {
    const Cut* cut = this->Cuts.data();
    while (cut->Second != 0)
    {
      cut += p[cut->Axis] < cut->At ? 1 : cut->Second;
    }
    return cut->Region;
  }

private:
  /// A node of the tree: its first child follows it, its second one comes `Second` nodes later; 0:
  /// it is a region.
  struct Cut
  {
    std::size_t Axis;
    double At;
    std::size_t Second;
    std::uint8_t Region;
  };

  void cut(Point3* begin, Point3* end, int first, int count);

  std::vector<Cut> Cuts;
};

} // namespace tipp

#endif
