// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/VtkFiles.h"

#include "Points/DataSetPoints.h"
#include "Vtk/ReadDataSet.h"

#include "vtkDataSet.h"

namespace tipp
{

PointTable readVtkPoints(const std::string& path)
{
  return pointsOf(readDataSet(path));
}

} // namespace tipp
