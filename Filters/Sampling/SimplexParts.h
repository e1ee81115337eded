// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSimplexParts_h
#define tippSimplexParts_h

#include "Resample/SimplexMesh.h"
#include "Vtk/CellArrays.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPointSet;

namespace tipp
{

/// Simplices of one dimension made from a data set's cells. Shares the data set's arrays if
/// possible; the data set must outlive it.
struct SimplexSet
{
  SimplexMesh Mesh; ///< a view of the simplices; its Ids and Hidden are owned by the members below
  std::vector<std::int64_t> Ids;     ///< the array behind Mesh.Ids if cells were cut
  PlainIds Stored;                   ///< the array behind Mesh.Ids if no cell was cut
  std::vector<std::int64_t> Parents; ///< cell of each simplex; empty: the same index
  std::vector<unsigned char> Hidden; ///< the array behind Mesh.Hidden
};

/// The simplices of all cells of a data set.
struct SimplexParts
{
  SimplexSet Triangles;
  SimplexSet Tetrahedra;
  std::int64_t Thin = 0;      ///< vertices and lines, which cover no sample
  std::int64_t NotFinite = 0; ///< cells left out because a corner is not finite

  vtkSmartPointer<vtkDataArray> Coordinates; ///< float or double
};

/// Returns the simplices of a mesh that has passed checkDataSet(). Hexahedra, voxels, wedges,
/// pyramids, quads and pixels are cut from their lexicographically least corners, so that
/// neighbours agree and neither order nor ids matter; other types are cut by VTK. Cells that
/// vtkGhostType hides are left out, and so are cells with a corner that is NaN or infinite along an
/// axis: along `axes`, or along all three if the mesh has three-dimensional cells.
SimplexParts makeSimplices(vtkPointSet* mesh, const std::vector<int>& axes, int threads);

/// The same for a surface. Throws std::runtime_error, with the surface's `name`, if it has cells
/// with a volume.
SimplexParts makeTriangles(
  vtkPointSet* mesh, const std::string& name, const std::vector<int>& axes, int threads);

/// Whether the mesh has three-dimensional cells.
VTKTIPPFILTERS_EXPORT bool hasVolumes(vtkPointSet* mesh);

/// Hides the simplices with a marked corner; `markedPoints` is indexed by point id.
void hideMarked(SimplexSet& simplices, const std::vector<bool>& markedPoints);

} // namespace tipp

#endif
