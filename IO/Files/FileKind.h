// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFileKind_h
#define tippFileKind_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Returns a path's extension in lower case with its dot, such as ".vtp"; empty if there is none.
VTKTIPPIO_EXPORT std::string extensionOf(const std::string& path);

/// For a file of a known kind that TIPP does not read, such as Gmsh's: names the kind and a command
/// that converts it; else empty.
std::string conversionAdvice(const std::string& path);

/// Throws IOError: with that advice, or else with `problem`.
[[noreturn]] void refuseKind(const std::string& path, const std::string& problem);

} // namespace tipp

#endif
