// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVirtualHdf_h
#define tippVirtualHdf_h

#include "Partitioned/PartitionedMesh.h"

#include <string>

namespace tipp
{

/// Writes mesh.vtkhdf, which VTK reads as an unstructured grid with a partition for each piece. Its
/// arrays are virtual: their values are in the pieces' files, whose names are relative to the
/// mesh's folder. Returns once it is on the disk. Throws IOError.
void writeVirtualHdf(const PartitionedMesh& mesh);

/// If a file is the mesh.vtkhdf of a partitioned mesh, throws IOError unless it has its checksum
/// and all of the mesh's files are there, in their sizes: HDF5 reads zeros for the others.
void requirePiecesOf(const std::string& vtkHdf);

/// Throws IOError if a cell of a VTKHDF file has no type. HDF5 gives zeros, without an error, for a
/// piece that is missing or cut, as in a copy of mesh.vtkhdf without its pieces.
void requireCellType(const std::string& vtkHdf, unsigned char type);

} // namespace tipp

#endif
