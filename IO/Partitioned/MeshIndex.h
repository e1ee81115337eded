// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshIndex_h
#define tippMeshIndex_h

#include "Partitioned/PartitionedMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>

namespace tipp
{

/// Returns the text of index.json including its checksum; `pvtu` is the text of mesh.pvtu.
std::string indexText(const PartitionedMesh& mesh, const std::string& pvtu);

/// Parses such a text; `path` is the index's, for errors. Checks everything that needs no other
/// file and throws IOError. PartitionedMesh::Path is left empty.
VTKTIPPIO_EXPORT PartitionedMesh parseIndex(const std::string& text, const std::string& path);

} // namespace tipp

#endif
