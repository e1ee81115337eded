// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleOnDevice_h
#define tippSampleOnDevice_h

#include "Resample/DirectSampling.h"
#include "Resample/MeshOnDevice.h"

#include <vector>

namespace tipp
{

/// Whether sampleOnDevice() can do all of the arrays: a few of points and of numbers that are not
/// whole.
bool canSampleOnDevice(const std::vector<Attribute>& attributes);

/// sampleDirectly() on an OpenCL device, to be finished by finishDirectly(). Throws
/// AcceleratorError.
SampledCells sampleOnDevice(MeshPieces& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, unsigned char* valid, const Report& report);

} // namespace tipp

#endif
