// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBoundingPoints_h
#define tippBoundingPoints_h

#include "vtkSmartPointer.h"

class vtkPoints;

namespace tipp
{

/// The points in double precision, and after them eight on a circle about the centre of their
/// bounding box, at its middle height; the radius is `offset` times the box's diagonal.
vtkSmartPointer<vtkPoints> appendBoundingPoints(vtkPoints* points, double offset);

} // namespace tipp

#endif
