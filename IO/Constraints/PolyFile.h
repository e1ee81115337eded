// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPolyFile_h
#define tippPolyFile_h

#include "Constraints/ConstraintTable.h"

#include <string>

namespace tipp
{

/// A .poly file of Shewchuk's Triangle (https://www.cs.cmu.edu/~quake/triangle.poly.html):
/// vertices, segments and holes; further lines are not read. Without vertices of its own it has
/// those of the .node file of the same name. Throws IOError.
ConstraintTable readPolyFile(const std::string& path);

} // namespace tipp

#endif
