// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatMesh_h
#define tippFlatMesh_h

#include "Arrays/Scalar.h"
#include "Files/InputFile.h"
#include "Files/MeshDescription.h"
#include "Files/RawArray.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

class MeshSeries;

/// A mesh of triangles or of tetrahedra as arrays in files. Nothing is loaded, so the mesh may be
/// larger than memory. The sizes of all arrays have been checked against their files. Point indices
/// have not: CellReader checks them as it reads.
struct FlatMesh
{
  std::string Path; ///< the folder or the .vtu file
  int CellSize = 3; ///< points per cell: 3 for triangles, 4 for tetrahedra
  RawArray Cells;   ///< CellSize point indices per cell, Int32 or Int64
  RawArray Points;  ///< 2 or 3 coordinates per point, Float32 or Float64
  std::vector<RawArray> PointData;
  std::vector<RawArray> CellData;

  std::vector<double> Times; ///< times of the steps, ascending; empty for a static mesh
  /// Arrays that vary in time: one RawArray per time step for each of them.
  std::vector<std::vector<RawArray>> PointSeries;
  std::vector<std::vector<RawArray>> CellSeries;

  std::int64_t OtherCells = 0;      ///< vertices and lines of a .vtp file, which are left out
  MeshDescription Description = {}; ///< what the numbers mean; empty if the files do not say
};

/// Opens one of two:
/// - a folder of .npy arrays, little-endian and in C order: `cells.npy` (m x 3 or m x 4, int32 or
///   int64), `points.npy` (n x 2 or n x 3, float32 or float64), `point_data/NAME.npy` (n or n x c,
///   any numbers or booleans) and `cell_data/NAME.npy`. If there is `time.npy` (T values,
///   ascending), arrays of T x n or T x n x c vary in time. In a file name, % and two hexadecimal
///   digits encode a byte of the array name, such as `%2F` a slash. `description.json`, if it is
///   there, says what the numbers mean: see descriptionText();
/// - a .vtu file with appended, raw, uncompressed, little-endian data and one piece of only
///   triangles or only tetrahedra, read in place. Arrays of strings are skipped. In a build without
///   VTK also such a .vtp file, whose vertices and lines are left out.
/// Throws IOError for anything else, with the reason.
VTKTIPPIO_EXPORT FlatMesh openFlatMesh(const std::string& path);

/// Whether the path looks like a flat mesh: a folder that has cells.npy and points.npy, or a .vtu
/// file with an appended raw, uncompressed header. Opening it may still fail.
VTKTIPPIO_EXPORT bool isFlatMesh(const std::string& path);

/// Throws IOError if the mesh has OtherCells, for work in which the numbers of cells matter.
void requireNoOtherCells(const FlatMesh& mesh);

/// Implement openFlatMesh() and isFlatMesh() for .vtu and .vtp files.
///@{
FlatMesh openFlatVtu(const std::string& path);
bool isFlatVtu(const std::string& path);
///@}

/// Reads the cells of a flat mesh, as 64-bit point indices, and checks these.
class VTKTIPPIO_EXPORT CellReader
{
public:
  /// `threads` = 0: usualThreads(). Throws IOError if the file cannot be opened.
  explicit CellReader(const FlatMesh& mesh, int threads = 0);

  /// Reads cells [first, first + cells) into `ids`, which is resized: CellSize point indices each.
  /// Throws IOError naming the first cell with a point index that is out of range,
  /// std::out_of_range if the mesh does not have these cells.
  void read(std::int64_t first, std::int64_t cells, std::vector<std::int64_t>& ids) const;

private:
  void readBlock(std::int64_t firstId, std::int64_t count, std::int64_t* ids) const;
  [[noreturn]] void reportBadId(
    std::int64_t firstId, std::int64_t count, const std::int64_t* ids) const;

  RawArray Cells;
  std::int64_t Points;
  int CellSize;
  int Threads;
  InputFile File;
};

/// Returns the file name, without extension, for an array: slashes, control characters, per cent
/// signs and a leading dot become % and two hexadecimal digits.
VTKTIPPIO_EXPORT std::string arrayFileName(const std::string& name);

/// The inverse of arrayFileName(). A % that two hexadecimal digits do not follow is kept.
VTKTIPPIO_EXPORT std::string arrayNameOf(const std::string& fileName);

/// An array in memory to be written: Tuples x Components values, or Steps times as many if it
/// varies in time.
struct FlatArray
{
  std::string Name;
  Scalar Type = Scalar::Float64;
  int Components = 1;
  std::int64_t Tuples = 0;
  std::int64_t Steps = 0;            ///< 0: the array does not vary in time
  const void* Values = nullptr;      ///< step by step, then tuple by tuple; null with StepValues
  std::shared_ptr<const void> Owner; ///< owns Values, or null if the caller does
  /// If set, called once for each step, from 0, or for 0 if the array does not vary: returns the
  /// step's values, which stay valid until the next call.
  std::function<const void*(std::int64_t step)> StepValues = {};
};

/// The content of a flat mesh to be written.
struct FlatContent
{
  int CellSize = 3;                ///< points per cell: 3 for triangles, 4 for tetrahedra
  std::vector<std::int64_t> Cells; ///< CellSize point indices per cell
  FlatArray Points;                ///< 2 or 3 coordinates per point
  std::vector<FlatArray> PointData;
  std::vector<FlatArray> CellData;
  std::vector<double> Times;        ///< times of the steps, ascending; empty for a static mesh
  MeshDescription Description = {}; ///< what the numbers mean
};

/// Writes a folder that openFlatMesh can open; point indices as int32 if they fit. The folder is
/// published only when it is complete. Returns false if `aborted`, called between arrays, returned
/// true; throws IOError.
VTKTIPPIO_EXPORT bool writeFlatMesh(
  const std::string& path, const FlatContent& content, const std::function<bool()>& aborted = {});

/// Converts the output of a model, with its variables as point and cell data. Values are read when
/// they are written, step by step; so `series` must outlive the content. Cells that are parts of
/// others have the cell data "OriginalCellId". `marksMissing`: missing values are the mark that the
/// model's users know, such as -99999, if it has one, instead of NaN. Throws IOError.
VTKTIPPIO_EXPORT FlatContent flattenSeries(MeshSeries& series, bool marksMissing = true);

} // namespace tipp

#endif
