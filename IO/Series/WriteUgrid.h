// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteUgrid_h
#define tippWriteUgrid_h

#include "Arrays/Scalar.h"
#include "Files/PendingOutput.h"
#include "Predicates/Geometry.h"
#include "Series/MeshSeries.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Values at the nodes or triangles of a mesh to be written.
struct UgridArray
{
  std::string Name;
  std::string LongName; ///< may be empty
  std::string Units;    ///< may be empty
  Scalar Type = Scalar::Float64;
  bool OnCells = false;
  bool Varies = false; ///< has values of its own for each time step
  /// Returns the values of a step, valid until the next call; called once a step, or once.
  std::function<const void*(std::size_t step)> Values;
  std::string StandardName = {}; ///< of CF; may be empty
};

/// A mesh of triangles in the plane to be written. Clockwise triangles are turned.
struct UgridContent
{
  std::int64_t Nodes = 0;
  std::int64_t Triangles = 0;
  std::function<Point2(std::int64_t node)> Node;
  std::function<std::int64_t(std::int64_t triangle, int corner)> Corner;
  std::vector<UgridArray> Arrays;
  std::vector<double> Times; ///< of the steps, ascending
  std::string TimeUnits;     ///< in the manner of CF; may be empty
  std::string Calendar;
  std::string Crs;    ///< any text that GDAL understands; may be empty
  std::string Source; ///< what the mesh comes from, such as the name of a file
};

/// The content of a model's output. Values are read when they are written; so `series` must outlive
/// the content. Triangles that are parts of other cells have the array "OriginalCellId". Throws
/// IOError.
VTKTIPPIO_EXPORT UgridContent ugridOf(MeshSeries& series);

/// Throws IOError in a build without NetCDF if the path is that of a NetCDF file to be written: so
/// that a long computation does not end with this error.
VTKTIPPIO_EXPORT void requireNetcdfFor(const std::string& output);

/// Writes a NetCDF-4 file by UGRID 1.0 and CF 1.8, compressed. Values that are NaN are the fill
/// value. `before` as for PendingFile. The file appears only when it is complete. Returns false if
/// `aborted` returned true; throws IOError, also in a build without NetCDF.
VTKTIPPIO_EXPORT bool writeUgrid(const std::string& path, const UgridContent& content,
  const std::optional<PathState>& before, const std::function<bool()>& aborted);

} // namespace tipp

#endif
