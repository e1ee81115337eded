// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/DescribeMesh.h"

#include "Files/IOError.h"
#include "Partitioned/PieceFormat.h"

namespace tipp
{

void describeColumns(const std::vector<std::string>& columns, std::size_t elevation,
  const OutOfCoreRunOptions& options, PointRowLayout& rows, PartitionedMesh& mesh)
{
  rows.Words = 3 + columns.size();
  rows.Z = elevation < columns.size() ? int(2 + elevation) : -1;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    if (i != elevation)
    {
      mesh.Arrays.push_back({ columns[i], true, Scalar::Float64, 1, -1 });
      rows.Attributes.push_back(int(2 + i));
    }
  }
  if (options.MapDuplicates)
  {
    mesh.Arrays.push_back({ "RepresentativePointId", true, Scalar::Int64, 1, -1 });
    rows.Attributes.push_back(-1);
  }
  if (options.Neighbors)
  {
    mesh.Arrays.push_back(neighborIdsArray);
    mesh.Arrays.back().Components = mesh.CellSize;
  }
  const std::string name = mesh.Path.empty() ? "" : repeatedName(mesh.Arrays); // else not written
  if (!name.empty())
  {
    throw IOError("The input has two columns named " + name +
      ", or one named as the mesh names an array of its own; rename it, or leave it out.");
  }
}

} // namespace tipp
