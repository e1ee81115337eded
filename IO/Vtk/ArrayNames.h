// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippArrayNames_h
#define tippArrayNames_h

#include "Files/ShownText.h"
#include "vtkTIPPIOModule.h"

#include <set>
#include <string>

class vtkFieldData;

namespace tipp
{

/// The names of the arrays; unnamed ones are skipped.
VTKTIPPIO_EXPORT std::set<std::string> arrayNames(vtkFieldData* data);

} // namespace tipp

#endif
