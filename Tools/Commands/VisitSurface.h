// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVisitSurface_h
#define tippVisitSurface_h

#include "Files/PendingOutput.h"
#include "Parallel/ParallelFor.h"
#include "Sampling/RemapSurface.h"
#include "Sampling/SurfacePart.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tipp
{

/// How a mesh is read as a surface.
struct SurfaceReading
{
  std::string Name;      ///< what messages call it
  std::vector<int> Axes; ///< cells with a corner that is not finite along one of them are left out
  /// In bytes: of the part of a partitioned mesh that is in memory.
  std::uint64_t Memory = std::numeric_limits<std::uint64_t>::max();
  int Threads = 0;
};

/// Reads a mesh and calls visit(part, report) for each part: a partitioned mesh in parts of about
/// the given memory, other files whole. Ghost cells are left out. Returns false if a visit did.
/// Throws IOError, and std::runtime_error for cells with a volume.
bool visitSurface(const std::string& path, const SurfaceReading& reading, const Report& report,
  const std::function<bool(const SurfacePart& part, const Report& report)>& visit);

/// A surface in a file, and how its cells are written again with other arrays.
struct TargetSurface
{
  SurfacePart Surface;
  std::function<void(
    const std::string& path, const PathState& before, const std::vector<SurfaceMeans>& means)>
    Write;
};

/// Reads the target of means. `requireExtension` is called with the extension that a file of its
/// cells must have, before they are cut into triangles. Throws as visitSurface().
TargetSurface readTarget(const std::string& path, const SurfaceReading& reading,
  const std::function<void(const std::string& extension)>& requireExtension);

} // namespace tipp

#endif
