// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUnknownKind_h
#define tippUnknownKind_h

#include <string>

namespace tipp
{

/// For a path of a known kind that is not read here, as Gmsh's, what it is and the command that
/// converts it; else empty.
std::string conversionAdvice(const std::string& path);

/// Throws IOError: with that advice, or else with `problem`.
[[noreturn]] void refuseKind(const std::string& path, const std::string& problem);

} // namespace tipp

#endif
