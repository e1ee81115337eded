// SPDX-License-Identifier: BSD-3-Clause
#include "Models/ModelMesh.h"
#include "Series/MeshSeries.h"

#include <utility>

namespace tipp
{

ModelMesh readSeriesMesh(const std::string& path, ModelPart part)
{
  const std::unique_ptr<MeshSeries> series = openMeshSeries(path);
  ModelMesh mesh;
  if (part == ModelPart::Nodes)
  {
    mesh.XY = series->readNodes();
  }
  else
  {
    SeriesMesh read = series->readMesh();
    mesh.XY = std::move(read.XY);
    mesh.Triangles = std::move(read.Triangles);
    mesh.OriginalCells = std::move(read.OriginalCells);
  }
  for (std::size_t i = 0; i < series->Variables.size(); ++i)
  {
    const SeriesVariable& variable = series->Variables[i];
    if (!variable.OnCells && !variable.Varies)
    {
      series->read(i, 0, mesh.Columns.emplace_back(ModelMesh::Column{ variable.Name, {} }).Values);
    }
  }
  return mesh;
}

} // namespace tipp
