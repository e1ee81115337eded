// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleOnDevice_h
#define tippResampleOnDevice_h

#include "Resample/DirectSampling.h"
#include "Resample/MeshOnDevice.h"
#include "Resample/Resample.h"

#include <vector>

namespace tipp
{

/// Whether sampleOnDevice() supports all of the arrays: a few floating-point point arrays.
bool canSampleOnDevice(const std::vector<Attribute>& attributes);

/// sampleDirectly() on an OpenCL device; finishDirectly() completes the result. Throws
/// AcceleratorError.
SampledCells sampleOnDevice(MeshPieces& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, unsigned char* valid, const Report& report);

/// claimSamples() on an OpenCL device. The device's filters decide most cells; threads of this
/// process do the undecided ones and those at the border. The claims are the same; the statistics
/// count only the undecided cells. Throws AcceleratorError.
Claims claimOnDevice(MeshPieces& mesh, const Lattice& lattice, const Report& report);

/// Interpolates floating-point point arrays at samples that a cell claims in `claims`; otherwise as
/// interpolate(). If `keeps`, the other samples are not changed, else they are undefined; only the
/// window's samples are transferred. Returns false if `report` stopped it. Throws AcceleratorError.
bool interpolateOnDevice(MeshPieces& mesh, const SampleWindow& window, const std::int32_t* claims,
  const std::vector<Attribute>& attributes, bool keeps, const Report& report);

} // namespace tipp

#endif
