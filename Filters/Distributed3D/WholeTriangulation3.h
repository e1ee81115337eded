// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWholeTriangulation3_h
#define tippWholeTriangulation3_h

#include "Arrays/Buffer.h"
#include "Distributed/CellExchange.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <vector>

namespace tipp
{

/// The triangulation of all points by one rank: tetrahedra or, if the points are coplanar,
/// triangles. Ids are indices into the points.
struct WholeTriangulation3
{
  WholeTriangulation3(
    const Buffer<Point3>& points, const TetrahedralizationOptions& options, int threads);

  std::vector<IdCell<4>> Cells; ///< in triangles, the last corner is repeated
  std::vector<Duplicate> Duplicates;
  int Dimension = -1;   ///< see Tetrahedralization
  bool Aborted = false; ///< Progress stopped the run

private:
  void takeTriangles(const Buffer<Point3>& points, const TetrahedralizationOptions& options);
};

} // namespace tipp

#endif
