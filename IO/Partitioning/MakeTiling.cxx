// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/MakeTiling.h"

#include "Files/IOError.h"
#include "Partitioning/PartitionRun.h"

namespace tipp
{

BoxTiling makeTiling(const PartitionRun& run, const Box3& domain)
{
  const TilingChoice& choice = run.Options.Tiling;
  if (choice.Threshold > 0)
  {
    throw IOError("trees are not there yet.");
  }
  std::array<int, 3> boxes = choice.Boxes;
  // The plane has no third axis to cut.
  boxes[2] = run.Rows.Dimension == 2 ? 1 : boxes[2];
  return BoxTiling::grid(run.Rows.Dimension, domain, boxes);
}

} // namespace tipp
