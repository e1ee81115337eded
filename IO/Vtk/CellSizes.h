// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellSizes_h
#define tippCellSizes_h

#include <cstdint>

namespace tipp
{

/// Whether VTK has this cell type.
bool isCellType(int type);

/// The number of vertices of a cell type; 0 if it varies.
int cellSizeOf(int type);

/// Whether a cell of the type can have `size` vertices.
bool isCellSize(int type, std::int64_t size);

} // namespace tipp

#endif
