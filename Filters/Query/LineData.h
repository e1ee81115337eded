// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLineData_h
#define tippLineData_h

#include "Query/Around.h"
#include "Query/Lines.h"
#include "Query/RankAnswer.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>

namespace tipp
{

/// Creates a closed polyline for each loop. The points have their ids as VTK's global ids, in the
/// array "GlobalPointIds".
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(const BoundaryLoops& loops);

/// Creates a polyline for each contour line, with the cell array `name` of its level.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(
  const Contours& contours, const std::string& name);

/// Creates a polyline for each descent that has points. Cell arrays are "StartId", the descent's
/// index, and "PitId"; the point array `name` has the values.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(
  const Descents& descents, const std::string& name);

/// Creates one polyline with the point arrays "Distance", "CellId" and those of the profile, whose
/// memory is moved into the result.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(Profile&& profile);

/// Creates a vertex for each point, with the arrays of the answer, "CellId", "AskingRank" and
/// "AskingId". The memory of the answer's arrays is moved into the result.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(StayingAnswer&& answer);

/// Creates an array that takes the ownership of the values' memory, without a copy.
vtkSmartPointer<vtkDataArray> takeOver(MeshAnswer::Array& values);

} // namespace tipp

#endif
