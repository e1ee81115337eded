// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRepresentativeIds_h
#define tippRepresentativeIds_h

#include "Triangulation/Triangulate.h"

#include "vtkSmartPointer.h"

class vtkIdTypeArray;

namespace tipp
{

/// Returns for each of `points` input points the id of its representative: its own id, for a
/// duplicate the representative's, for a rejected point -1.
vtkSmartPointer<vtkIdTypeArray> representativeIds(
  const Triangulation& triangulation, std::int64_t points);

} // namespace tipp

#endif
