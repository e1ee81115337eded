// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatMesh_h
#define tippFlatMesh_h

#include "Flat/RawArray.h"
#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// A mesh of triangles or of tetrahedra as arrays in files. Nothing is loaded, so the mesh may be
/// larger than memory. The sizes of all arrays have been checked against their files. Point indices
/// have not: CellReader checks them as it reads.
struct FlatMesh
{
  std::string Path;
  int CellSize = 3; ///< points per cell: 3 for triangles, 4 for tetrahedra
  RawArray Cells;   ///< CellSize point indices per cell, Int32 or Int64
  RawArray Points;  ///< 2 or 3 coordinates per point, Float32 or Float64
  std::vector<RawArray> PointData;
  std::vector<RawArray> CellData;

  std::vector<double> Times; ///< of the time steps, ascending; empty for a static mesh
  /// Arrays that vary in time: one RawArray per time step for each of them.
  std::vector<std::vector<RawArray>> PointSeries;
  std::vector<std::vector<RawArray>> CellSeries;
};

/// Opens one of two:
/// - a folder of .npy arrays, little-endian and in C order: `cells.npy` (m x 3 or m x 4, int32 or
///   int64), `points.npy` (n x 2 or n x 3, float32 or float64), `point_data/NAME.npy` (n or n x c,
///   any numbers or booleans) and `cell_data/NAME.npy`. With `time.npy` (T values, ascending) an
///   array of T x n or T x n x c varies in time. In a file name, % and two hexadecimal digits
///   encode a byte of the array name, such as `%2F` a slash;
/// - a .vtu file with appended, raw, uncompressed, little-endian data and one piece of only
///   triangles or only tetrahedra, read in place. Arrays of strings are skipped.
/// Throws IOError for anything else, with the reason.
VTKTIPPIO_EXPORT FlatMesh openFlatMesh(const std::string& path);

/// Whether the path looks like a flat mesh: a folder that has cells.npy and points.npy, or a .vtu
/// file with an appended raw, uncompressed header. Opening it may still fail.
VTKTIPPIO_EXPORT bool isFlatMesh(const std::string& path);

} // namespace tipp

#endif
