// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteLines_h
#define tippWriteLines_h

#include "Files/PendingOutput.h"
#include "Gis/GisFiles.h"
#include "Query/Queries.h"
#include "vtkTIPPFiltersModule.h"

#include <string>

namespace tipp
{

/// @name Lines as .vtp files
/// They write one polyline for each line, like the data sets of polyDataOf(), without VTK. `before`
/// as for PendingFile. They throw IOError.
///@{
/// Writes contour lines. The cell array `name` is their level.
VTKTIPPFILTERS_EXPORT void writeContours(const std::string& path, const PathState& before,
  const Contours& contours, const std::string& name);

/// Writes the descents that have points. The cell arrays are StartId, the descent's index, and
/// PitId; the point array `name` has the values.
VTKTIPPFILTERS_EXPORT void writeDescents(const std::string& path, const PathState& before,
  const Descents& descents, const std::string& name);
///@}

} // namespace tipp

#endif
