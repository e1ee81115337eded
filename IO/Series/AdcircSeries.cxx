// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"
#include "Adcirc/AdcircValues.h"
#include "Series/LoadedSeries.h"
#include "Series/ModelSeries.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

/// The variable's name. ADCIRC's own file names, such as fort.63, keep their extension, which
/// identifies the content.
std::string nameOf(const std::string& path)
{
  const std::filesystem::path file(path);
  return file.stem() == "fort" ? file.filename().string() : file.stem().string();
}

} // namespace

std::unique_ptr<MeshSeries> openAdcircSeries(const std::string& path, const SeriesOptions& options)
{
  constexpr double dry = -99999;
  AdcircGrid grid = readAdcircGrid(path);
  ModelMesh mesh;
  mesh.XY = std::move(grid.XY);
  mesh.Triangles = std::move(grid.Triangles);
  mesh.Columns.push_back({ "depth", grid.Depth });
  auto series = std::make_unique<LoadedSeries>(path, "ADCIRC", std::move(mesh), options);
  for (const std::string& file : options.Values)
  {
    AdcircValues values = readAdcircValues(file, grid);
    std::replace(
      values.Values.begin(), values.Values.end(), dry, std::numeric_limits<double>::quiet_NaN());
    SeriesVariable variable;
    variable.Name = nameOf(file);
    variable.Mark = dry;
    variable.Varies = values.Times.size() > 1;
    series->TimeUnits = variable.Varies ? "seconds" : series->TimeUnits;
    if (values.IsCutOff)
    {
      series->LeftOut.push_back({ "step " + std::to_string(values.Times.size()),
        "of " + std::filesystem::path(file).filename().string() +
          " is not complete: the file ends in it, as after an interrupted run" });
    }
    series->addValues(file, variable, values.Components, std::move(values.Values), values.Times);
  }
  return series;
}

std::unique_ptr<MeshSeries> openModelSeries(const std::string& path, const SeriesOptions& options)
{
  refuseValues(path, options);
  return std::make_unique<LoadedSeries>(
    path, "mesh", readModelMesh(path, ModelPart::Triangles), options);
}

} // namespace tipp
