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

/// A closed line for each loop; the points have "GlobalPointIds" as VTK's global ids.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(const BoundaryLoops& loops);

/// The lines, with their levels as a cell array called `name`.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(
  const Contours& contours, const std::string& name);

/// The lines that have points, with the cell arrays "StartId" (the line's index) and "PitId", and
/// the values as a point array called `name`.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(
  const Descents& descents, const std::string& name);

/// One line with the point arrays "Distance", "CellId" and those of the profile, whose memory it
/// takes over.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(Profile&& profile);

/// The points as vertices with the arrays of the answer, "CellId", "AskingRank" and "AskingId".
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(StayingAnswer&& answer);

/// Creates an array that takes over the memory of an answer's values.
vtkSmartPointer<vtkDataArray> takeOver(MeshAnswer::Array& values);

} // namespace tipp

#endif
