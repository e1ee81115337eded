// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlattenAdcirc.h"

#include "Adcirc/AdcircGrid.h"
#include "Adcirc/AdcircValues.h"
#include "Files/IOError.h"

#include <filesystem>
#include <utility>

namespace tipp
{
namespace
{

FlatArray floats(std::string name, std::vector<double> values, int components, std::int64_t tuples)
{
  const auto kept = std::make_shared<std::vector<double>>(std::move(values));
  return { std::move(name), Scalar::Float64, components, tuples, 0, kept->data(), kept };
}

/// ADCIRC's own names, such as fort.63, keep their extension: the number tells what they hold.
std::string nameOf(const std::string& path)
{
  const std::filesystem::path file(path);
  return file.stem() == "fort" ? file.filename().string() : file.stem().string();
}

void addValues(const std::string& path, const AdcircGrid& grid, FlatContent& content)
{
  AdcircValues values = readAdcircValues(path, grid);
  const std::int64_t nodes = content.Points.Tuples;
  FlatArray array = floats(nameOf(path), std::move(values.Values), values.Components, nodes);
  if (values.Times.size() > 1)
  {
    if (!content.Times.empty() && content.Times != values.Times)
    {
      throw IOError(path, "has other times than the file before it; flatten them one by one.");
    }
    content.Times = std::move(values.Times);
    array.Steps = std::int64_t(content.Times.size());
  }
  content.PointData.push_back(std::move(array));
}

} // namespace

FlatContent flattenAdcirc(const std::string& grid, const std::vector<std::string>& values)
{
  AdcircGrid read = readAdcircGrid(grid);
  FlatContent content;
  content.Cells = std::move(read.Triangles);
  const auto nodes = std::int64_t(read.Depth.size());
  content.Points = floats("points", std::move(read.XY), 2, nodes);
  content.PointData.push_back(floats("depth", read.Depth, 1, nodes));
  for (const std::string& path : values)
  {
    addValues(path, read, content);
  }
  return content;
}

} // namespace tipp
