// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWholeTriangulation3_h
#define tippWholeTriangulation3_h

#include "Arrays/Buffer.h"
#include "Distributed/CellExchange.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <vector>

namespace tipp
{

/// What one rank makes of all points: tetrahedra or, of points in one plane, triangles. Ids are
/// indices into the points.
struct WholeTriangulation3
{
  WholeTriangulation3(
    const Buffer<Point3>& points, const TetrahedralizationOptions& options, int threads);

  std::vector<IdCell<4>> Cells; ///< triangles have their last corner twice
  std::vector<Duplicate> Duplicates;
  int Dimension = -1;   ///< as of Tetrahedralization
  bool Aborted = false; ///< by Progress

private:
  void takeTriangles(const Buffer<Point3>& points, const TetrahedralizationOptions& options);
};

} // namespace tipp

#endif
