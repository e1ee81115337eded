// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExtension_h
#define tippExtension_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Returns a path's extension in lower case with its dot, such as ".vtp"; empty if there is none.
VTKTIPPIO_EXPORT std::string extensionOf(const std::string& path);

} // namespace tipp

#endif
