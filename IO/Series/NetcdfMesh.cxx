// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfMesh.h"

#include "Files/IOError.h"

namespace tipp
{
void setMeshDimensions(const std::string& path, const NetcdfContent& content, NetcdfMesh& mesh,
  const std::string& cellDimension)
{
  const auto fail = [&](const NetcdfVariable& variable, const std::string& problem)
  { throw IOError(path, "'" + variable.Name + "' " + problem + "; copy the file again."); };
  if (mesh.Corners->Dimensions.size() != 2)
  {
    fail(*mesh.Corners, "should have two dimensions: cells and corners");
  }
  if (!mesh.Corners->Type || !mesh.X->Type || !mesh.Y->Type || (mesh.Counts && !mesh.Counts->Type))
  {
    fail(!mesh.X->Type ? *mesh.X : !mesh.Y->Type ? *mesh.Y : *mesh.Corners, "should be numbers");
  }
  const bool hasBoth = mesh.X == mesh.Y;
  if (mesh.X->Dimensions.size() != (hasBoth ? 2 : 1) || mesh.X->Dimensions != mesh.Y->Dimensions ||
    (hasBoth && content.size(mesh.X->Dimensions[0]) != 2))
  {
    fail(*mesh.X, "should have one dimension, the nodes, and '" + mesh.Y->Name + "' the same");
  }
  mesh.NodeDimension = mesh.X->Dimensions.back();
  const std::vector<std::int64_t> shape = content.shape(*mesh.Corners);
  const int stated = content.findDimension(cellDimension);
  const bool isSecond = stated >= 0 ? stated == mesh.Corners->Dimensions[1]
                                    : (shape[0] == 3 || shape[0] == 4) && shape[1] > 4;
  mesh.CellDimension = mesh.Corners->Dimensions[isSecond ? 1 : 0];
  if (shape[isSecond ? 0 : 1] < 3)
  {
    fail(*mesh.Corners, "should have at least three corners per cell");
  }
  for (const NetcdfVariable* part : { mesh.X, mesh.Y, mesh.Corners })
  {
    mesh.Parts.insert(part->Name);
  }
}

bool isInDegrees(const NetcdfMesh& mesh)
{
  const std::string units = mesh.X->text("units");
  return units.compare(0, 6, "degree") == 0 || units.compare(0, 3, "rad") == 0 ||
    mesh.X->text("standard_name") == "longitude" || mesh.X->Name == "nodes" ||
    mesh.X->Name == "lonVertex" || mesh.X->Name == "lonCell";
}

} // namespace tipp
