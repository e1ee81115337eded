// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/ClassifyCells.h"

#include "Partition/CellShape.h"
#include "Partition/ClassifyOnThreads.h"

namespace tipp
{

Membership classifyCells(
  const CellsView& cells, const BoxTiling& tiling, const ClassifyOptions& options)
{
  const CellShape shape(cells, tiling.dimension());
  return classifyOnThreads(cells, tiling, shape, options.Threads);
}

} // namespace tipp
