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

/// Sets the run's number of triangles and its checksum.
void sumUp(vtkPolyData* mesh, Run& run);

} // namespace benchmark
} // namespace tipp

#endif
