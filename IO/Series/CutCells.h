// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCutCells_h
#define tippCutCells_h

#include "Series/MeshSeries.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The cells of a model's mesh as its file has them. All corners are valid.
struct CellMesh
{
  std::vector<double> XY;            ///< x and y of the nodes, interleaved
  std::vector<std::int64_t> Corners; ///< node indices, cell after cell
  /// The first corner of each cell, and the number of corners; empty: the cells are triangles.
  std::vector<std::int64_t> Offsets;
  bool IsInDegrees = false; ///< x is longitudes, y latitudes
  /// The index in the file of each cell, if the cells are parts of the file's; empty otherwise.
  std::vector<std::int64_t> Originals;

  std::int64_t cells() const
  {
    return std::int64_t(
      this->Offsets.empty() ? this->Corners.size() / 3 : this->Offsets.size() - 1);
  }
};

/// The result of cutCells().
struct CutMesh
{
  SeriesMesh Mesh;
  /// The nodes added after the nodes of the file: each is a copy of the node with this index.
  std::vector<std::int64_t> Copies;
  std::vector<SeriesLeftOut> LeftOut;
};

/// Cuts the cells into triangles; OriginalCells are indices of `cells`. Cells without corners are
/// left out. Where `wrap`, cells that cross the meridian at which longitudes
/// jump are in the mesh twice: on either side of it, with copies of nodes, so that a range of 360
/// degrees is covered; and cells that contain a pole are left out. Otherwise, cells that are more
/// than 180 degrees wide are an error if the mesh is known to be in degrees. Throws IOError with
/// the path and the cell.
CutMesh cutCells(CellMesh cells, bool wrap, const std::string& path);

} // namespace tipp

#endif
