// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNeighborArray_h
#define tippNeighborArray_h

#include "Triangulation/Triangulate.h"

#include "vtkSmartPointer.h"

class vtkIdTypeArray;

namespace tipp
{

/// Returns the array "NeighborIds": for each corner of a triangle the index of the triangle across
/// the opposite edge, or -1.
vtkSmartPointer<vtkIdTypeArray> neighborArray(const Triangulation& triangulation);

} // namespace tipp

#endif
