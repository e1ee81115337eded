// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStandardInput_h
#define tippStandardInput_h

#include <string>

namespace tipp
{

/// The path at which a text input can be opened, as often as needed: for "-", the standard input,
/// that of a temporary copy, made when it is first asked for; else the path itself. Throws IOError.
std::string openablePath(const std::string& path);

} // namespace tipp

#endif
