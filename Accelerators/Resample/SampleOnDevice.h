// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleOnDevice_h
#define tippSampleOnDevice_h

#include "Resample/DirectSampling.h"
#include "Resample/MeshOnDevice.h"

#include <vector>

namespace tipp
{

/// Whether sampleOnDevice() supports all of the arrays: a few floating-point point arrays.
bool canSampleOnDevice(const std::vector<Attribute>& attributes);

/// sampleDirectly() on an OpenCL device; finishDirectly() completes the result. Throws
/// AcceleratorError.
SampledCells sampleOnDevice(MeshPieces& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, unsigned char* valid, const Report& report);

} // namespace tipp

#endif
