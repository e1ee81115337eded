// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattenImage_h
#define tippFlattenImage_h

#include "Flat/Flattened.h"
#include "Flat/RawVtkFile.h"

#include <string>
#include <vector>

namespace tipp
{

/// The points of an image, x first.
std::vector<double> imagePoints(const RawVtkFile& file);

/// Does without VTK what flattenDataSet() does with the image of a .vti file. `path`: the file, for
/// messages. Throws IOError also if the memory of this machine cannot hold the result.
Flattened flattenImage(const RawVtkFile& file, const std::string& path);

} // namespace tipp

#endif
