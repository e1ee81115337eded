// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVisitMesh_h
#define tippVisitMesh_h

#include "Parallel/ParallelFor.h"

#include <cstdint>
#include <functional>
#include <string>

class vtkPointSet;

namespace tipp
{

/// Reads a mesh and calls visit(part, report) for each part: a partitioned mesh in parts of about
/// `memory` bytes, the files of VTK whole. Ghost cells are left out. Returns false if a visit did.
/// Throws IOError.
bool visitMesh(const std::string& path, std::uint64_t memory, int threads, const Report& report,
  const std::function<bool(vtkPointSet* part, const Report& report)>& visit);

} // namespace tipp

#endif
