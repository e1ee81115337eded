// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshOnDevice_h
#define tippMeshOnDevice_h

#include "OpenCL/ComputeDevice.h"
#include "Resample/SimplexMesh.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// How many cells go to the device at once, beside `others` bytes there, with point arrays of
/// `tuple` bytes a point. `memory` is how many bytes may be used, 0: half of the device's. All
/// cells if the whole mesh fits. Throws AcceleratorError if none fits.
std::int64_t cellsOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::size_t tuple,
  std::size_t others, std::uint64_t memory);

/// Some cells of a mesh for the kernels of ClaimSamples.cl: all, with the mesh's own points, or a
/// piece, with the corners of each cell side by side.
class MeshOnDevice
{
public:
  MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::int64_t first,
    std::int64_t count, int threads);

  /// A point array for these points.
  cl::Buffer values(const SimplexMesh& mesh, const void* values, std::size_t tupleBytes) const;

  cl::Buffer Points;
  cl::Buffer Ids;
  cl_int Float;
  cl_int Wide;
  cl_int Corners;
  cl_int U;
  cl_int V;

private:
  const ComputeDevice& Device;
  std::int64_t First;
  std::int64_t Count;
  bool Whole;
  std::vector<double> Gathered; ///< must last as long as Points
  std::vector<std::int32_t> Numbers;
  mutable std::vector<std::vector<char>> GatheredValues;
};

} // namespace tipp

#endif
