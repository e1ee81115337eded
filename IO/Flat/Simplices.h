// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSimplices_h
#define tippSimplices_h

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
  int CellSize = 3;              ///< 4 if the data set has cells with a volume
  std::vector<std::int64_t> Ids; ///< CellSize point ids each, tetrahedra with positive volume
  /// The cell that each comes from; empty if each is the cell of its own number.
  std::vector<std::int64_t> Parents;
  std::map<std::string, std::int64_t>
    Cut; ///< cells that were cut into several, by VTK's class name
  /// Cells left out, by what they are: those of a lower dimension than others (points, lines, and
  /// triangles beside tetrahedra), empty ones, and ghosts, which stand for another piece's cells.
  std::map<std::string, std::int64_t> LeftOut;

  std::int64_t count() const { return std::int64_t(this->Ids.size()) / this->CellSize; }
};

/// Faces are cut by fans around their point of lowest id, and volumes by joining their own point of
/// lowest id to all other faces, so that neighbours agree. (Known as pulling; Dompierre and others,
/// "How to Subdivide Pyramids, Prisms, and Hexahedra into Tetrahedra", 1999.) Throws IOError with
/// the path if there is nothing with an area or a volume, or a curved cell other than a quadratic
/// triangle or tetrahedron.
VTKTIPPIO_EXPORT Simplices simplicesOf(vtkDataSet* data, const std::string& path);

} // namespace tipp

#endif
