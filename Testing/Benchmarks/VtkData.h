// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBenchmarkVtkData_h
#define tippBenchmarkVtkData_h

#include "Engines.h"

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace tipp
{
namespace benchmark
{

/// The points at z = 0, in double precision.
vtkSmartPointer<vtkPolyData> toPolyData(const std::vector<double>& xy);

/// Counts the triangles and takes their checksum.
void sumUp(vtkPolyData* mesh, Run& run);

} // namespace benchmark
} // namespace tipp

#endif
