// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/ClassifyCells.h"

#include "Partition/CellShape.h"
#include "Partition/ClassifyOnDevice.h"
#include "Partition/ClassifyOnThreads.h"

#include <utility>

namespace tipp
{

Membership classifyCells(
  const CellsView& cells, const BoxTiling& tiling, const ClassifyOptions& options)
{
  const CellShape shape(cells, tiling.dimension());
  std::optional<Membership> onDevice =
    classifyOnDevice(options.Device, cells, tiling, shape, options.DeviceMemory);
  return onDevice ? std::move(*onDevice) : classifyOnThreads(cells, tiling, shape, options.Threads);
}

} // namespace tipp
