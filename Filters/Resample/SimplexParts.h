// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSimplexParts_h
#define tippSimplexParts_h

#include "Resample/SimplexMesh.h"
#include "Vtk/PlainIds.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <vector>

class vtkDataArray;
class vtkPointSet;

namespace tipp
{

/// Simplices of one dimension made of a data set's cells. Its arrays are the data set's own where
/// they can be; the data set must outlive it.
struct SimplexSet
{
  SimplexMesh Mesh;
  std::vector<std::int64_t> Ids;     ///< what Mesh.Ids points to, if the cells had to be cut up
  PlainIds Stored;                   ///< what Mesh.Ids points to, if they did not
  std::vector<std::int64_t> Parents; ///< the cell that each is a part of; empty: the same number
  std::vector<unsigned char> Hidden; ///< what Mesh.Hidden points to
};

/// All cells of a data set.
struct SimplexParts
{
  SimplexSet Triangles;
  SimplexSet Tetrahedra;
  std::int64_t Thin = 0;      ///< vertices and lines, which cover no sample
  std::int64_t NotFinite = 0; ///< cells left out for a corner whose coordinates are not finite

  vtkSmartPointer<vtkDataArray> Coordinates; ///< float or double
};

/// Triangles and tetrahedra as they are; other cells cut up. Hexahedra, voxels, wedges, pyramids,
/// quads and pixels are cut by their lexicographically least corners, so that neighbours agree and
/// neither order nor ids matter; other types as VTK does it. Cells that vtkGhostType hides are left
/// out, and those with a corner that is NaN or infinite along one of the axes that count: `axes`,
/// or all three if the mesh has cells with a volume. The mesh has passed checkCells().
SimplexParts makeSimplices(vtkPointSet* mesh, const std::vector<int>& axes, int threads);

/// Whether it has cells with a volume.
bool hasVolumes(vtkPointSet* mesh);

/// Hides the simplices that have a corner marked.
void hideMarked(SimplexSet& simplices, const std::vector<bool>& markedPoints);

} // namespace tipp

#endif
