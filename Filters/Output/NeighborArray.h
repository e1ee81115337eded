// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNeighborArray_h
#define tippNeighborArray_h

#include "Triangulation/Triangulate.h"

#include "vtkSmartPointer.h"

class vtkIdTypeArray;

namespace tipp
{

/// "NeighborIds": for each corner of a triangle the place of the triangle opposite to it, or -1.
vtkSmartPointer<vtkIdTypeArray> neighborArray(const Triangulation& triangulation);

} // namespace tipp

#endif
