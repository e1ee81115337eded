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

Bounds boundsOf(const Box2& box, double factor)
{
  return { box.xmin / factor, box.xmax / factor, box.ymin / factor, box.ymax / factor, 0, 0 };
}

Bounds boundsOf(const Box3& box, double factor)
{
  return { box.Min[0] / factor, box.Max[0] / factor, box.Min[1] / factor, box.Max[1] / factor,
    box.Min[2] / factor, box.Max[2] / factor };
}

} // namespace tipp
