// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLegacyFileCheck_h
#define tippLegacyFileCheck_h

#include <string>

namespace tipp
{

/// checkVtkFile() for a legacy file (.vtk). It also walks through the cells of a file before
/// version 5, whose counts VTK follows without a check.
void checkLegacyFile(const std::string& path);

} // namespace tipp

#endif
