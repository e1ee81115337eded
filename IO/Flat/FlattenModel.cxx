// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include "Models/ModelMesh.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// An array that owns its values.
FlatArray ownedArray(std::string name, std::vector<double> values, int components)
{
  const auto kept = std::make_shared<std::vector<double>>(std::move(values));
  const auto tuples = std::int64_t(kept->size()) / components;
  return { std::move(name), Scalar::Float64, components, tuples, 0, kept->data(), kept };
}

} // namespace

FlatContent flattenModel(const std::string& path)
{
  ModelMesh mesh = readModelMesh(path, ModelPart::Triangles);
  FlatContent content;
  content.Cells = std::move(mesh.Triangles);
  content.Points = ownedArray("points", std::move(mesh.XY), 2);
  for (ModelMesh::Column& column : mesh.Columns)
  {
    content.PointData.push_back(ownedArray(column.Name, std::move(column.Values), 1));
  }
  if (!mesh.Regions.empty())
  {
    content.CellData.push_back(ownedArray("Region", std::move(mesh.Regions), 1));
  }
  return content;
}

} // namespace tipp
