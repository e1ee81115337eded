// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatFolder_h
#define tippFlatFolder_h

#include "Flat/FlatMesh.h"

namespace tipp
{

/// Implements openFlatMesh for a folder.
FlatMesh openFlatFolder(const std::string& path);
bool isFlatFolder(const std::string& path);

} // namespace tipp

#endif
