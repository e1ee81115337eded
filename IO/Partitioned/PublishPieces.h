// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPublishPieces_h
#define tippPublishPieces_h

#include "Files/PendingOutput.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceTable.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The folders that a new mesh may replace: partitioned meshes.
VTKTIPPIO_EXPORT extern const Replaceable replaceableMesh;

/// A piece whose file is complete, with its summary and table except for what it borrows.
struct FinishedPiece
{
  PieceSummary Summary;
  PieceTable Table;              ///< without checksums of arrays that are not written yet
  std::uint64_t TriangleSum = 0; ///< without a file: sum of hashTriangle()
};

struct PublishedMesh
{
  std::uint64_t Bytes = 0;       ///< of all files
  std::uint64_t Fingerprint = 0; ///< checksum of the index, which identifies the mesh
};

/// Writes tables, .pvtu and, last, the index into the mesh's folder, and completes mesh.Pieces. The
/// pieces' files must have been synced. Throws IOError, also if one of them does not have its
/// expected size.
VTKTIPPIO_EXPORT PublishedMesh publishPieces(
  PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces);

/// Whether the folder holds the mesh with this fingerprint, and each of its files has its expected
/// size.
VTKTIPPIO_EXPORT bool holdsMesh(const std::string& path, std::uint64_t fingerprint);

/// Throws IOError unless the folder holds the mesh with this fingerprint and every byte of its
/// files is intact.
VTKTIPPIO_EXPORT void verifyMesh(const std::string& path, std::uint64_t fingerprint, int threads);

} // namespace tipp

#endif
