// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/DescribeArrays.h"

#include "Files/IOError.h"
#include "Partitioned/PieceLayout.h"

#include <set>
#include <string>
#include <utility>

namespace tipp
{

std::vector<RawArray> describeArrays(const FlatMesh& mesh, PartitionedMesh& result)
{
  std::vector<RawArray> arrays;
  std::set<std::pair<bool, std::string>> names{ { true, pointIdsName }, { true, ghostsName },
    { false, cellIdsName }, { false, ghostsName } };
  const auto add = [&](const RawArray& array, bool ofPoints, int step)
  {
    const StoredArray stored{ array.Name, ofPoints, array.Type, array.Components, step };
    if (!names.emplace(ofPoints, storedName(stored)).second)
    {
      throw IOError(mesh.Path,
        "has two arrays named " + storedName(stored) +
          ", or one named as the partitioned mesh names its own; rename it.");
    }
    result.Arrays.push_back(stored);
    arrays.push_back(array);
  };
  for (const bool ofPoints : { true, false })
  {
    for (const RawArray& array : ofPoints ? mesh.PointData : mesh.CellData)
    {
      add(array, ofPoints, -1);
    }
    for (const std::vector<RawArray>& series : ofPoints ? mesh.PointSeries : mesh.CellSeries)
    {
      for (std::size_t step = 0; step < series.size(); ++step)
      {
        add(series[step], ofPoints, int(step));
      }
    }
  }
  return arrays;
}

} // namespace tipp
