// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCutCells_h
#define tippCutCells_h

#include "Series/MeshSeries.h"

#include <cstdint>
#include <memory>
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
};

/// Consecutive cells of a file.
struct CellBlock
{
  std::int64_t First = 0; ///< the index of the first cell
  ///@{ As in CellMesh.
  std::vector<std::int64_t> Corners;
  std::vector<std::int64_t> Offsets;
  ///@}

  std::int64_t cells() const
  {
    return std::int64_t(
      this->Offsets.empty() ? this->Corners.size() / 3 : this->Offsets.size() - 1);
  }
};

/// Reads the cells of a file block by block.
class CellBlocks
{
public:
  virtual ~CellBlocks() = default;
  /// Reads the nodes; called once, first. Throws IOError.
  virtual SeriesNodes readNodes() = 0;
  /// Reads the next cells; false after the last ones. Throws IOError.
  virtual bool next(CellBlock& block) = 0;

  std::int64_t Cells = 0;              ///< their number
  bool IsInDegrees = false;            ///< x is longitudes, y latitudes
  std::vector<std::int64_t> Originals; ///< as in CellMesh
};

/// Cells that are in memory, as one block.
std::unique_ptr<CellBlocks> sourceOf(CellMesh cells);

/// Cuts the cells of a file into triangles. Cells without corners are left out. Where `wrap`, cells
/// that cross the meridian at which longitudes jump are in the mesh twice: on either side of it,
/// with copies of nodes, so that a range of 360 degrees is covered; and cells that contain a pole
/// are left out. Otherwise, cells that are more than 180 degrees wide are an error if the mesh is
/// known to be in degrees. Functions throw IOError with the path and the cell.
class CellCutter
{
public:
  CellCutter(SeriesNodes nodes, bool isInDegrees, bool wrap, const std::string& path);
  ~CellCutter();
  CellCutter(const CellCutter&) = delete;
  CellCutter& operator=(const CellCutter&) = delete;

  SeriesTriangles cut(CellBlock block);

  /// The nodes of the file and the copies up to now.
  SeriesNodes& nodes();
  /// The cells left out up to now.
  std::vector<SeriesLeftOut> leftOut() const;

private:
  class Work;
  std::unique_ptr<Work> Cutting;
};

} // namespace tipp

#endif
