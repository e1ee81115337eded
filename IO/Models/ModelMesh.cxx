// SPDX-License-Identifier: BSD-3-Clause
#include "Models/ModelMesh.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/Formats.h"

#include <utility>

namespace tipp
{
namespace
{

ModelMesh readAdcircMesh(const std::string& path, ModelPart part)
{
  AdcircGrid grid = part == ModelPart::Triangles ? readAdcircGrid(path) : readAdcircNodes(path);
  ModelMesh mesh;
  mesh.XY = std::move(grid.XY);
  mesh.Columns.push_back({ "depth", std::move(grid.Depth) });
  mesh.Triangles = std::move(grid.Triangles);
  return mesh;
}

} // namespace

ModelMesh readModelMesh(const std::string& path, ModelPart part)
{
  switch (openerOf(path, Use::Triangles))
  {
    case Opener::Adcirc:
      return readAdcircMesh(path, part);
    case Opener::Sms:
      return readSmsMesh(path, part);
    case Opener::Gmsh:
      return readGmshMesh(path, part);
    case Opener::Triangle:
      return readTriangleMesh(path, part);
    case Opener::Netcdf:
    case Opener::Selafin:
      return readSeriesMesh(path, part);
    default:
      refuseKind(path, "has no extension that tells a kind of mesh of a model.");
  }
}

bool isModelMesh(const std::string& path)
{
  const Opener opener = openerOf(path, Use::Triangles);
  return opener == Opener::Adcirc || opener == Opener::Sms || opener == Opener::Gmsh ||
    opener == Opener::Triangle || opener == Opener::Netcdf || opener == Opener::Selafin;
}

} // namespace tipp
