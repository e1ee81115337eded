// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtkFiles_h
#define tippVtkFiles_h

#include "Flat/FlattenDataSet.h"
#include "Resident/MeshPart.h"

#include <functional>
#include <string>

namespace tipp
{

/// @name What commands do with files that VTK reads
/// They throw IOError, also in a build without VTK.
///@{
/// Reads a mesh of any cells for queries. Throws std::runtime_error, with one sentence that does
/// not name the file, if it cannot be queried.
MeshPart readVtkPart(const std::string& path, int threads);

/// Reads a mesh and calls use() with its triangles or tetrahedra: see flattenDataSet().
void flattenVtkFile(
  const std::string& path, const std::function<void(const Flattened& flattened)>& use);
///@}

} // namespace tipp

#endif
