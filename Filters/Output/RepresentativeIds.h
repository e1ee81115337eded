// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRepresentativeIds_h
#define tippRepresentativeIds_h

#include "Triangulation/Triangulate.h"

#include "vtkSmartPointer.h"

class vtkIdTypeArray;

namespace tipp
{

/// For each point the id of the point that stands for it: its own, for a duplicate its
/// representative's, for a rejected point -1.
vtkSmartPointer<vtkIdTypeArray> representativeIds(const Triangulation& triangulation,
  std::int64_t points);

} // namespace tipp

#endif
