// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleOnDevice_h
#define tippResampleOnDevice_h

#include "OpenCL/ComputeDevice.h"
#include "Resample/Resample.h"

namespace tipp
{

/// claimSamples() on an OpenCL device: what its filters decide, it decides; the threads of this
/// process do the cells in doubt and those at the border. The same result. `memory` is how many
/// bytes of the device it may use, 0: half of them; a larger mesh goes there in pieces. Throws
/// AcceleratorError.
Claims claimOnDevice(ComputeDevice& device, const SimplexMesh& mesh, const Lattice& lattice,
  int threads, std::uint64_t memory, const Report& report);

/// The attributes of floating-point numbers of points where `claims` has a cell; like
/// interpolate() otherwise. Throws AcceleratorError.
void interpolateOnDevice(ComputeDevice& device, const SimplexMesh& mesh, const Lattice& lattice,
  const std::int32_t* claims, const std::vector<Attribute>& attributes, std::uint64_t memory);

} // namespace tipp

#endif
