// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRawVtkFile_h
#define tippRawVtkFile_h

#include "Files/InputFile.h"
#include "Files/RawArray.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The cells of one section of a VTK XML file, such as Polys.
struct RawCells
{
  std::int64_t Count = 0;
  RawArray Ids; ///< a plain list; its path is empty if the file has none
  RawArray Offsets;
};

/// The content of the XML part of a VTK file with appended raw data: .vtu, .vtp or .vti. Arrays are
/// used in place: their counts have been checked against the file's size and against the byte
/// counts before the data. What cells refer to has not been checked.
struct RawVtkFile
{
  std::string Kind; ///< UnstructuredGrid, PolyData or ImageData
  std::int64_t PointCount = 0;
  RawArray Points; ///< without a path for images
  RawCells Cells;  ///< of a .vtp file the polygons; of an image only their number
  RawArray Types;  ///< of the cells of a .vtu file
  RawCells Vertices;
  RawCells Lines;
  std::vector<RawArray> PointData;
  std::vector<RawArray> CellData; ///< of Cells alone
  /// Of an image.
  ///@{
  std::array<std::int64_t, 6> Extent = {};
  std::array<double, 3> Origin = {};
  std::array<double, 3> Spacing = {};
  ///@}
};

/// Throws IOError unless the file, whose kind its extension gives, is one piece of appended, raw,
/// uncompressed, little-endian data.
RawVtkFile openRawVtkFile(const InputFile& file);

/// Throws IOError unless the points have three coordinates, Float32 or Float64.
void requirePositions(const RawVtkFile& file, const std::string& path);

/// Returns what to do with a file of another kind.
std::string otherVtkAdvice(const std::string& path);

} // namespace tipp

#endif
