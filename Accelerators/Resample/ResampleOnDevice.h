// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleOnDevice_h
#define tippResampleOnDevice_h

#include "Resample/MeshOnDevice.h"
#include "Resample/Resample.h"

namespace tipp
{

/// claimSamples() on an OpenCL device: what its filters decide, it decides; the threads of this
/// process do the cells in doubt and those at the border. The same claims; the statistics count
/// the cells in doubt only. Throws AcceleratorError.
Claims claimOnDevice(MeshPieces& mesh, const Lattice& lattice, const Report& report);

/// The attributes of floating-point numbers of points where `claims` has a cell; like
/// interpolate() otherwise. Other samples keep what they have if `keeps`, else they are undefined;
/// only the window's go to the device and back.
/// False if `report` stopped it. Throws AcceleratorError.
bool interpolateOnDevice(MeshPieces& mesh, const SampleWindow& window, const std::int32_t* claims,
  const std::vector<Attribute>& attributes, bool keeps, const Report& report);

} // namespace tipp

#endif
