// SPDX-License-Identifier: BSD-3-Clause
#include "Series/LoadedSeries.h"

#include "Files/IOError.h"
#include "Series/CheckTimes.h"

#include <array>
#include <utility>

namespace tipp
{

LoadedSeries::LoadedSeries(
  const std::string& path, const std::string& kind, ModelMesh mesh, const SeriesOptions& options)
  : CellSeries(options.Wrap)
  , Mesh(std::move(mesh))
{
  this->Path = path;
  this->Kind = kind;
  for (ModelMesh::Column& column : this->Mesh.Columns)
  {
    this->addStatic(column.Name, std::move(column.Values), false);
  }
  this->Mesh.Columns.clear();
  if (!this->Mesh.Regions.empty())
  {
    this->addStatic("Region", std::move(this->Mesh.Regions), true);
  }
  this->setSize(
    std::int64_t(this->Mesh.XY.size() / 2), std::int64_t(this->Mesh.Triangles.size() / 3));
}

void LoadedSeries::addStatic(const std::string& name, std::vector<double> values, bool isOnCells)
{
  SeriesVariable variable;
  variable.Name = name;
  variable.OnCells = isOnCells;
  this->Variables.push_back(std::move(variable));
  this->Sources.push_back({ this->Values.size(), 0, 1 });
  this->Values.push_back(std::move(values));
}

void LoadedSeries::addValues(const std::string& path, const SeriesVariable& variable,
  int components, std::vector<double> values, const std::vector<double>& times)
{
  constexpr std::array<const char*, 3> axes = { "x", "y", "z" };
  if (variable.Varies)
  {
    checkTimes(path, times);
    if (!this->Times.empty() && this->Times != times)
    {
      throw IOError(path, "has other times than the file before it; read them one by one.");
    }
    this->Times = times;
  }
  for (int c = 0; c < components; ++c)
  {
    SeriesVariable part = variable;
    if (components > 1)
    {
      part.Vector = variable.Name;
      part.Name += std::string(".") + axes[std::size_t(c) % axes.size()];
    }
    for (const SeriesVariable& other : this->Variables)
    {
      if (other.Name == part.Name)
      {
        throw IOError(path,
          "has values with the name '" + part.Name + "', which others have; rename the file.");
      }
    }
    this->Variables.push_back(std::move(part));
    this->Sources.push_back({ this->Values.size(), std::size_t(c), std::size_t(components) });
  }
  this->Values.push_back(std::move(values));
}

std::unique_ptr<CellBlocks> LoadedSeries::openCells()
{
  CellMesh cells;
  cells.XY = this->Mesh.XY;
  cells.Corners = this->Mesh.Triangles;
  cells.Originals = this->Mesh.OriginalCells;
  return sourceOf(std::move(cells));
}

void LoadedSeries::readStored(std::size_t variable, std::size_t step, std::vector<double>& values)
{
  const Source& source = this->Sources.at(variable);
  const std::vector<double>& all = this->Values[source.Array];
  const bool isOnCells = this->Variables[variable].OnCells;
  const std::size_t count = isOnCells ? this->Mesh.Triangles.size() / 3 : this->Mesh.XY.size() / 2;
  values.resize(count);
  const std::size_t first = step * count * source.Components + source.Component;
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = all.at(first + i * source.Components);
  }
}

} // namespace tipp
