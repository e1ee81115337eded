// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattenDataSet_h
#define tippFlattenDataSet_h

#include "Flat/FlatMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

class vtkDataSet;

namespace tipp
{

/// A data set's cells as triangles or tetrahedra over its own points.
struct Simplices
{
  int CellSize = 3; ///< 4 if the data set has cells with a volume, else 3
  /// CellSize point ids per simplex; tetrahedra have positive volume
  std::vector<std::int64_t> Ids;
  /// The id of each simplex's cell in the data set; empty if it equals the simplex's index.
  std::vector<std::int64_t> Parents;
  std::map<std::string, std::int64_t>
    Cut; ///< number of cells that were cut into several, by VTK's class name
  /// Number of cells left out, by kind: cells of a lower dimension than others (points, lines, and
  /// triangles if there are tetrahedra), empty cells, and ghost cells, which another piece owns.
  std::map<std::string, std::int64_t> LeftOut;

  std::int64_t count() const { return std::int64_t(this->Ids.size()) / this->CellSize; }
};

/// Converts cells to simplices. A face is cut into a fan around its point of lowest id; a volume is
/// cut by joining its point of lowest id to all faces without that point, so that neighbours agree.
/// (Known as pulling; Dompierre and others, "How to Subdivide Pyramids, Prisms, and Hexahedra into
/// Tetrahedra", 1999.) Throws IOError with the path if no cell has an area or a volume, or if a
/// curved cell is not a quadratic triangle or tetrahedron.
VTKTIPPIO_EXPORT Simplices simplicesOf(vtkDataSet* data, const std::string& path);

/// The result of flattenDataSet().
struct Flattened
{
  FlatContent Content;                         ///< refers to the data set, which must outlive it
  std::map<std::string, std::int64_t> Cut;     ///< as in Simplices
  std::map<std::string, std::int64_t> LeftOut; ///< as in Simplices
  std::vector<std::string> ArraysLeftOut;      ///< arrays that are not numeric
};

/// Converts a data set's simplices, points (float32 if the input's are, else float64) and numeric
/// arrays. Ghost cells and vtkGhostType are left out. If cells are cut or left out, the cell data
/// "vtkOriginalCellIds" hold the index of each simplex's cell in `data`. Throws IOError as
/// simplicesOf does.
VTKTIPPIO_EXPORT Flattened flattenDataSet(vtkDataSet* data, const std::string& path);

} // namespace tipp

#endif
