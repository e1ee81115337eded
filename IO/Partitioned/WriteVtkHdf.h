// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteVtkHdf_h
#define tippWriteVtkHdf_h

#include "Files/PendingOutput.h"
#include "Partitioned/PartitionedMesh.h"
#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>

namespace tipp
{

/// Writes a partitioned mesh as a VTKHDF file that needs no other file: an unstructured grid with a
/// partition for each piece, in its order, and the time steps. One array of a piece is in memory at
/// a time. `before` as for PendingFile. Returns false if `aborted` returned true, which is called
/// for each piece; throws IOError.
VTKTIPPIO_EXPORT bool writeVtkHdf(const PartitionedMesh& mesh, const std::string& path,
  const PathState& before, const std::function<bool()>& aborted);

} // namespace tipp

#endif
