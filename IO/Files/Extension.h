// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExtension_h
#define tippExtension_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// A path's extension in lower case with its dot, as ".vtp"; empty if there is none.
VTKTIPPIO_EXPORT std::string extensionOf(const std::string& path);

} // namespace tipp

#endif
