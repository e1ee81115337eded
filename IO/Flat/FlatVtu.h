// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatVtu_h
#define tippFlatVtu_h

#include "Flat/FlatMesh.h"

namespace tipp
{

/// Implements openFlatMesh for a .vtu file.
FlatMesh openFlatVtu(const std::string& path);
bool isFlatVtu(const std::string& path);

} // namespace tipp

#endif
