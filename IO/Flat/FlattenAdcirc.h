// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattenAdcirc_h
#define tippFlattenAdcirc_h

#include "Flat/WriteFlatMesh.h"
#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// Converts an ADCIRC grid (AdcircGrid) with the point data "depth" and, for each file of values
/// (AdcircValues), point data named after the file without extension; "fort.63" and "fort.64" are
/// kept as they are. Several steps become an array that varies in time; files of several steps must
/// have equal times. Throws IOError.
VTKTIPPIO_EXPORT FlatContent flattenAdcirc(
  const std::string& grid, const std::vector<std::string>& values);

} // namespace tipp

#endif
