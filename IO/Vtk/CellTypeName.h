// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellTypeName_h
#define tippCellTypeName_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// VTK's name of a cell type; its number in a build without VTK.
VTKTIPPIO_EXPORT std::string cellTypeName(int type);

} // namespace tipp

#endif
