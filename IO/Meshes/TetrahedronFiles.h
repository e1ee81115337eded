// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedronFiles_h
#define tippTetrahedronFiles_h

#include "Meshes/MeshFiles.h"
#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The index of a table's column that is the third coordinate: named z, Z or elevation. Throws
/// IOError, with the file's name `path`, if there is none.
VTKTIPPIO_EXPORT std::size_t requireElevation(const PointTable& points, const std::string& path);

/// Writes tetrahedra of four point ids each: .npy (m x 4 int64; points are not written) or .vtu
/// (appended raw binary: all points, and all columns but the third coordinate as point data).
/// `neighbors`, if not empty, has four tetrahedron indices per tetrahedron and is written as
/// "NeighborIds". The file appears only when it is complete. Returns false if options.Aborted
/// returned true; throws IOError.
VTKTIPPIO_EXPORT bool writeTetrahedra(const std::string& path, PointTable points,
  const std::int32_t* ids, std::size_t tetrahedra, const std::vector<std::int64_t>& neighbors,
  const MeshOptions& options);

/// Tetrahedra read from a file.
struct StoredTetrahedra
{
  std::vector<std::int64_t> Ids;       ///< four point ids each, as stored in the file
  std::vector<double> XYZ;             ///< the file's own points; empty for an .npy file
  std::vector<std::int64_t> Neighbors; ///< four each, if the file has NeighborIds
};

/// Whether a file is of tetrahedra: .npy of four columns of integers, or a VTK file whose first
/// cell is one. Throws IOError.
VTKTIPPIO_EXPORT bool holdsTetrahedra(const std::string& path);

/// Reads tetrahedra from such a file. The ids are not checked. Throws IOError if the file cannot be
/// read or has other cells.
VTKTIPPIO_EXPORT StoredTetrahedra readTetrahedra(const std::string& path);

} // namespace tipp

#endif
