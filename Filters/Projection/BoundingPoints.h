// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBoundingPoints_h
#define tippBoundingPoints_h

#include "vtkSmartPointer.h"

class vtkPoints;

namespace tipp
{

/// Returns the points in double precision, followed by eight points on a circle around the centre
/// of their bounding box, at its middle height. The radius is `offset` times the box's diagonal.
vtkSmartPointer<vtkPoints> appendBoundingPoints(vtkPoints* points, double offset);

} // namespace tipp

#endif
