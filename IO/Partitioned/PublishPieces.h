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
  PieceTable Table;              ///< without checksums of arrays that are not written yet
  std::uint64_t TriangleSum = 0; ///< without a file: of GrowingPiece's hashes
};

struct PublishedMesh
{
  std::uint64_t Bytes = 0;       ///< of all files
  std::uint64_t Fingerprint = 0; ///< checksum of the index, which identifies the mesh
};

/// Writes what describes the pieces, the index last, into the mesh's folder, and completes
/// mesh.Pieces. The pieces' files must be safe on the disk. Throws IOError, also where one of these
/// does not have its size.
VTKTIPPIO_EXPORT PublishedMesh publishPieces(
  PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces);

/// Whether the folder holds the mesh with this fingerprint, and each of its files has its size.
VTKTIPPIO_EXPORT bool holdsMesh(const std::string& path, std::uint64_t fingerprint);

/// Throws IOError unless the folder holds the mesh with this fingerprint and every byte of its
/// files is as it was written.
VTKTIPPIO_EXPORT void verifyMesh(const std::string& path, std::uint64_t fingerprint, int threads);

} // namespace tipp

#endif
