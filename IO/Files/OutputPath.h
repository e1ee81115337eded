// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutputPath_h
#define tippOutputPath_h

#include <filesystem>
#include <string>

namespace tipp
{

/// Where an output of that name is to be put: absolute, without a slash at the end, and where a
/// link leads, for a rename would replace the link. Throws IOError if the folder around it is
/// missing or closed to us.
std::filesystem::path outputPath(const std::string& path);

/// Puts a finished output in its place; throws IOError.
void moveIntoPlace(const std::string& temporary, const std::string& path);

} // namespace tipp

#endif
