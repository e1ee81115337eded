// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfMesh.h"

namespace tipp
{

/// MPAS Mesh Specification, https://mpas-dev.github.io/files/documents/MPAS-MeshSpec.pdf: polygons
/// over vertices or, without them, the dual mesh of triangles over the centres of cells.
std::optional<NetcdfMesh> findMpasMesh(const std::string& path, const NetcdfContent& content)
{
  const NetcdfVariable* const polygons = content.find("verticesOnCell");
  const NetcdfVariable* const triangles = content.find("cellsOnVertex");
  if (!polygons && !triangles)
  {
    return std::nullopt;
  }
  const std::string on = polygons ? "Vertex" : "Cell";
  bool isPlanar = false;
  for (const NetcdfAttribute& attribute : content.Attributes)
  {
    isPlanar = isPlanar || (attribute.Name == "on_a_sphere" && attribute.Text.find("NO") == 0);
  }
  NetcdfMesh mesh;
  mesh.Kind = "MPAS";
  mesh.X = content.find((isPlanar ? "x" : "lon") + on);
  mesh.Y = content.find((isPlanar ? "y" : "lat") + on);
  mesh.Corners = polygons ? polygons : triangles;
  mesh.Counts = polygons ? content.find("nEdgesOnCell") : nullptr;
  if (!mesh.X || !mesh.Y)
  {
    return std::nullopt;
  }
  mesh.FirstNode = 1;
  mesh.SkipsIncomplete = !polygons;
  setMeshDimensions(path, content, mesh, polygons ? "nCells" : "nVertices");
  for (const char* name :
    { "nEdgesOnCell", "indexToCellID", "indexToVertexID", "lonCell", "latCell", "xCell", "yCell",
      "zCell", "lonVertex", "latVertex", "xVertex", "yVertex", "zVertex" })
  {
    mesh.Parts.insert(name);
  }
  return mesh;
}

} // namespace tipp
