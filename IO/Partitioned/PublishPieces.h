// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPublishPieces_h
#define tippPublishPieces_h

#include "Files/PendingFolder.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceTable.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// What a new mesh may take the place of.
VTKTIPPIO_EXPORT extern const Replaceable replaceableMesh;

/// A piece whose file is complete, and what is known of it; what it borrows is not.
struct FinishedPiece
{
  PieceSummary Summary;
  PieceTable Table;
  std::uint64_t TriangleSum = 0; ///< without a file: of GrowingPiece's hashes
};

/// Writes what describes the pieces, the index last, into the mesh's folder, and completes
/// mesh.Pieces. The pieces' files must be safe on the disk. Returns the bytes of all files. Throws
/// IOError.
VTKTIPPIO_EXPORT std::uint64_t publishPieces(
  PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces);

/// What tells the mesh in a folder from any other, by its index; 0 if there is none or files of it
/// are missing.
VTKTIPPIO_EXPORT std::uint64_t fingerprintOf(const std::string& path);

} // namespace tipp

#endif
