// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadFlatPiece_h
#define tippReadFlatPiece_h

#include "Flat/FlatMesh.h"
#include "Partitioned/ReadPiece.h"

namespace tipp
{

/// Reads all of a mesh that does not vary in time, with its points and cells in the file's order,
/// as a piece without global ids and ghosts. Points must have 3 coordinates. Throws IOError.
Piece readFlatPiece(const FlatMesh& mesh, int threads);

} // namespace tipp

#endif
