// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVectorFile_h
#define tippVectorFile_h

#include "Constraints/ConstraintTable.h"

#include <string>

namespace tipp
{

/// Reads the lines and polygons of all layers, by GDAL. Outer rings of polygons come out
/// counter-clockwise, the others clockwise, whichever way round the file has them; heights are NaN
/// where it has none. Throws IOError.
ConstraintTable readVectorFile(const std::string& path);

} // namespace tipp

#endif
