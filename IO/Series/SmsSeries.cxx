// SPDX-License-Identifier: BSD-3-Clause
#include "Files/InputFile.h"
#include "Models/ModelMesh.h"
#include "Series/LoadedSeries.h"
#include "Series/ModelSeries.h"
#include "Series/SmsDatasets.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

std::vector<SmsDataset> readSmsDatasets(const std::string& path, const SmsMeshShape& shape)
{
  constexpr std::int32_t version = 3000; // all binary files have it
  const InputFile file(path);
  std::int32_t first = 0;
  if (file.size() >= sizeof first)
  {
    file.read(0, &first, sizeof first);
  }
  return first == version ? readBinarySmsDatasets(path, shape) : readSmsText(path, shape);
}

} // namespace

std::unique_ptr<MeshSeries> openSmsSeries(const std::string& path, const SeriesOptions& options)
{
  ModelMesh mesh = readModelMesh(path, ModelPart::Triangles);
  const SmsMeshShape shape(mesh);
  auto series = std::make_unique<LoadedSeries>(path, "SMS", std::move(mesh), options);
  for (const std::string& file : options.Values)
  {
    for (SmsDataset& dataset : readSmsDatasets(file, shape))
    {
      SeriesVariable variable;
      variable.Name = dataset.Name;
      variable.Type = dataset.Type;
      variable.Varies = dataset.Times.size() > 1;
      series->addValues(
        file, variable, dataset.Components, std::move(dataset.Values), dataset.Times);
      series->TimeUnits = dataset.TimeUnits;
    }
  }
  return series;
}

} // namespace tipp
