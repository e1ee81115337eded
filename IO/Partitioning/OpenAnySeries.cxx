// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/OpenAnySeries.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Flat/FlatSeries.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/PiecesSeries.h"

namespace tipp
{

std::unique_ptr<MeshSeries> openAnySeries(const std::string& path, const SeriesOptions& options)
{
  if (isMeshSeries(path))
  {
    return openMeshSeries(path, options);
  }
  const bool isPartitioned = isPartitionedMesh(path);
  if (!isPartitioned && !isFlatMesh(path))
  {
    throw IOError(path,
      "is not a mesh with time steps that are read one after another; flatten it first, as with "
      "'tipp flatten " +
        path + " -o mesh'.");
  }
  if (!options.Values.empty() || options.Wrap)
  {
    throw IOError(path,
      std::string("is a stored mesh, which has all values and is not changed; leave out ") +
        (options.Wrap ? "--wrap, or flatten the model's output with it." : "--values."));
  }
  return isPartitioned ? openPiecesSeries(path) : openFlatSeries(path);
}

} // namespace tipp
