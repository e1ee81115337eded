// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBestFittingPlane_h
#define tippBestFittingPlane_h

#include "vtkSmartPointer.h"

class vtkPoints;
class vtkTransform;

namespace tipp
{

/// Moves the points' least-squares plane to the plane z = 0 and their centroid to the origin.
/// Points with a NaN or infinite coordinate do not count; null without any other.
vtkSmartPointer<vtkTransform> bestFittingPlane(vtkPoints* points);

} // namespace tipp

#endif
