// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellSizes_h
#define tippCellSizes_h

#include <cstdint>

namespace tipp
{

/// Whether VTK has cells of this type.
bool isCellType(int type);

/// How many vertices all cells of a type have; 0 if the number varies.
int cellSizeOf(int type);

/// Whether a cell of the type can have so many vertices.
bool isCellSize(int type, std::int64_t size);

} // namespace tipp

#endif
