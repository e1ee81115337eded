// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtuHeader_h
#define tippVtuHeader_h

#include "Flat/RawArray.h"

#include <string>
#include <vector>

namespace tipp
{

class InputFile;

/// The content of the XML part of a .vtu file with appended raw data. Arrays are used in place:
/// their counts have been checked against the file's size and against the byte counts before the
/// data.
struct VtuHeader
{
  std::int64_t Points = 0;
  std::int64_t Cells = 0;
  std::vector<RawArray> PointData;
  std::vector<RawArray> CellData;
  RawArray Coordinates;
  RawArray Connectivity; ///< its Tuples follow from the byte count
  RawArray Offsets;
  RawArray Types;
};

/// Throws IOError unless the file is one piece of appended, raw, uncompressed, little-endian data.
VtuHeader readVtuHeader(const InputFile& file);

} // namespace tipp

#endif
