// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClassifyOnDevice_h
#define tippClassifyOnDevice_h

#include "OpenCL/DeviceChoice.h"
#include "Partition/CellShape.h"

#include <cstdint>
#include <optional>

namespace tipp
{

/// classifyCells() on an OpenCL device, in pieces that need at most `memory` bytes of it besides
/// the tiling (0: half of its memory). What the device leaves undecided is decided on the CPU.
/// Returns nullopt if the choice is OpenMP. Throws AcceleratorError.
std::optional<Membership> classifyOnDevice(const DeviceChoice& choice, const CellsView& cells,
  const BoxTiling& tiling, const CellShape& shape, std::uint64_t memory);

} // namespace tipp

#endif
