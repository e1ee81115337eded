// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/ClassifyCells.h"

#include "Partition/CellShape.h"
#include "Partition/ClassifyOnDevice.h"
#include "Partition/ClassifyOnThreads.h"

namespace tipp
{

Membership classifyCells(
  const CellsView& cells, const BoxTiling& tiling, const ClassifyOptions& options)
{
  const CellShape shape(cells, tiling.dimension());
  ComputeDevice* device = ComputeDevice::open(options.Device);
  return device != nullptr ? classifyOnDevice(*device, cells, tiling, shape, options.DeviceMemory)
                           : classifyOnThreads(cells, tiling, shape, options.Threads);
}

} // namespace tipp
