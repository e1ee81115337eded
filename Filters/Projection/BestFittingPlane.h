// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBestFittingPlane_h
#define tippBestFittingPlane_h

#include "vtkSmartPointer.h"

class vtkPoints;
class vtkTransform;

namespace tipp
{

/// Returns the transform that moves the points' least-squares plane to the plane z = 0 and their
/// centroid to the origin. Points with a NaN or infinite coordinate are ignored; returns null if
/// there are no others.
vtkSmartPointer<vtkTransform> bestFittingPlane(vtkPoints* points);

} // namespace tipp

#endif
