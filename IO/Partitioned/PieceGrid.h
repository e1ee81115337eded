// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceGrid_h
#define tippPieceGrid_h

#include "Partitioned/ReadPiece.h"
#include "vtkTIPPIOModule.h"

#include "vtkSmartPointer.h"

class vtkUnstructuredGrid;

namespace tipp
{

/// Converts a piece to a VTK data set that takes ownership of its memory: global ids as such,
/// vtkGhostType of points, and of cells if the piece has borrowed ones.
VTKTIPPIO_EXPORT vtkSmartPointer<vtkUnstructuredGrid> makeGrid(Piece&& piece);

} // namespace tipp

#endif
