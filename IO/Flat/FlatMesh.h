// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatMesh_h
#define tippFlatMesh_h

#include "Flat/RawArray.h"
#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// A mesh of triangles or of tetrahedra as arrays in files, none of them loaded: its size does not
/// matter. The sizes of all arrays are checked against their files, vertex ids are not: CellReader
/// checks them as it reads.
struct FlatMesh
{
  std::string Path;
  int CellSize = 3; ///< vertices a cell: 3 for triangles, 4 for tetrahedra
  RawArray Cells;   ///< CellSize vertex ids a cell, Int32 or Int64
  RawArray Points;  ///< 2 or 3 coordinates a vertex, Float32 or Float64
  std::vector<RawArray> PointData;
  std::vector<RawArray> CellData;

  std::vector<double> Times; ///< of the steps, ascending; empty for a mesh without time
  /// Arrays that vary in time: for each of them, one RawArray a step.
  std::vector<std::vector<RawArray>> PointSeries;
  std::vector<std::vector<RawArray>> CellSeries;
};

/// Opens one of two:
/// - a folder of .npy arrays, little-endian and in C order: `cells.npy` (m x 3 or m x 4, int32 or
///   int64), `points.npy` (n x 2 or n x 3, float32 or float64), `point_data/NAME.npy` (n or n x c,
///   any numbers or booleans) and `cell_data/NAME.npy`. With `time.npy` (T values, ascending) an
///   array of T x n or T x n x c varies in time. A `%2F` in a file's name stands for a slash in the
///   array's, and so on for any byte;
/// - a .vtu file with appended, raw, uncompressed, little-endian data and one piece of nothing but
///   triangles or nothing but tetrahedra, read in place. Arrays of strings are passed over.
/// Throws IOError for anything else, naming the fact.
VTKTIPPIO_EXPORT FlatMesh openFlatMesh(const std::string& path);

/// Whether the path looks like one of the two: a folder that has cells.npy and points.npy, or a
/// .vtu file with an appended raw, uncompressed header. Opening it may still fail.
VTKTIPPIO_EXPORT bool isFlatMesh(const std::string& path);

} // namespace tipp

#endif
