// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellMeans_h
#define tippCellMeans_h

#include "Predicates/Geometry.h"
#include "Resident/ResidentMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Means of values over the cells of a mesh's nodes. The cell of a node has the points of triangles
/// for which its barycentric coordinate is the largest; of equal ones that of the lowest node.
class CellMeans
{
public:
  /// `threads`: 0: defaultThreads(). Nodes of other parts of the mesh have no meaning.
  CellMeans(const MeshPart& part, int threads);

  /// Adds values at points, in their order. Points outside of the mesh are left out.
  void add(const std::vector<Point3>& points, const std::vector<double>& values);

  /// The mean of the values in a node's cell; NaN if there are none.
  double meanOf(std::size_t node) const;

private:
  const MeshPart Part;
  const ResidentMesh Mesh;
  std::vector<double> Sums; ///< per node
  std::vector<std::int64_t> Counts;
};

} // namespace tipp

#endif
