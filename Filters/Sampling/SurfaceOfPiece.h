// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurfaceOfPiece_h
#define tippSurfaceOfPiece_h

#include "Partitioned/ReadPiece.h"
#include "Sampling/SurfacePart.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Returns the triangles of a piece without its borrowed ones, and its arrays, without ghosts.
/// Cells with a corner that is not finite along `axes` are left out. Throws std::runtime_error,
/// with the mesh's `name`, if it has cells with a volume.
SurfacePart surfaceOf(Piece piece, const std::string& name, const std::vector<int>& axes);

/// Returns for each of a piece's own cells whether vtkGhostType hides it.
std::vector<unsigned char> hiddenCells(const Piece& piece);

/// Marks the points with a coordinate along the axes that is not finite. Returns whether there are
/// any.
bool markNotFinite(const Piece& piece, const std::vector<int>& axes, std::vector<bool>& marked);

/// Hides the cells with a marked corner. Returns the number of those that were not hidden before.
std::int64_t hideAt(
  const Piece& piece, const std::vector<bool>& marked, std::vector<unsigned char>& hidden);

/// Returns a view of a piece's own cells; triangles are seen along the two axes.
SimplexMesh meshOf(const Piece& piece, const std::vector<int>& axes);

/// The values of an array as doubles: its own, or those in `copy`.
const double* doublesOf(const Piece::Attribute& attribute, std::vector<double>& copy);

} // namespace tipp

#endif
