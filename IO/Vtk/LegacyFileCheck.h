// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLegacyFileCheck_h
#define tippLegacyFileCheck_h

#include <string>

namespace tipp
{

/// Implements checkVtkFile() for a legacy file (.vtk). It also traverses the cells of a file before
/// version 5, whose counts VTK does not check.
void checkLegacyFile(const std::string& path);

} // namespace tipp

#endif
