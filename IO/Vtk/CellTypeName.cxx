// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/CellTypeName.h"

#if __has_include("vtkCellTypeUtilities.h") // VTK 9.6
#include "vtkCellTypeUtilities.h"
#else
#include "vtkCellTypes.h"
#endif

namespace tipp
{

std::string cellTypeName(int type)
{
#if __has_include("vtkCellTypeUtilities.h")
  return vtkCellTypeUtilities::GetClassNameFromTypeId(type);
#else
  return vtkCellTypes::GetClassNameFromTypeId(type);
#endif
}

} // namespace tipp
