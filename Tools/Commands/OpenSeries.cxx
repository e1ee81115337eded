// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/OpenSeries.h"

#include "Commands/PointArguments.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/OpenAnySeries.h"

#include <fmt/format.h>

#include <cstddef>

namespace tipp
{

std::unique_ptr<MeshSeries> openSeries(const std::string& path, const SeriesOptions& options)
{
  if (!isMeshSeries(path))
  {
    const std::string kind = isPartitionedMesh(path) ? "a partitioned mesh" : "a flat mesh";
    refuseIf(!options.Values.empty(), "--values", "is not for " + kind + ", which has all values");
    refuseIf(options.Wrap, "--wrap", "is not for " + kind + "; give it to 'tipp flatten'");
  }
  std::unique_ptr<MeshSeries> series = openAnySeries(path, options);
  if (!series->LeftOut.empty())
  {
    const SeriesLeftOut& first = series->LeftOut.front();
    const std::size_t more = series->LeftOut.size() - 1;
    fmt::print(stderr, "tipp: warning: {}: {} {}, and is left out{}.\n", path, first.Name,
      first.Reason,
      more == 0 ? "" : fmt::format("; so are {} more, which 'tipp info' lists", more));
  }
  return series;
}

} // namespace tipp
