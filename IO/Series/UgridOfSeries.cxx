// SPDX-License-Identifier: BSD-3-Clause
#include "Series/WriteUgrid.h"

#include <memory>
#include <utility>

namespace tipp
{
namespace
{

/// Whole numbers may be missing, too, so values are floats that represent all of them.
Scalar floatFor(Scalar type)
{
  const bool fits = type == Scalar::Float32 || type == Scalar::Int8 || type == Scalar::UInt8 ||
    type == Scalar::Int16 || type == Scalar::UInt16;
  return fits ? Scalar::Float32 : Scalar::Float64;
}

/// Reads the values of a variable in the type to be written.
class ValueReader
{
public:
  ValueReader(MeshSeries& series, std::size_t variable)
    : Series(series)
    , Variable(variable)
    , Type(floatFor(series.Variables[variable].Type))
  {
  }

  const void* read(std::size_t step)
  {
    this->Series.read(this->Variable, step, this->Values);
    if (this->Type == Scalar::Float64)
    {
      return this->Values.data();
    }
    this->Floats.assign(this->Values.begin(), this->Values.end());
    return this->Floats.data();
  }

private:
  MeshSeries& Series;
  const std::size_t Variable;
  const Scalar Type;
  std::vector<double> Values;
  std::vector<float> Floats;
};

} // namespace

UgridContent ugridOf(MeshSeries& series)
{
  const auto mesh = std::make_shared<SeriesMesh>(series.readMesh());
  UgridContent content;
  content.Nodes = std::int64_t(mesh->XY.size() / 2);
  content.Triangles = std::int64_t(mesh->Triangles.size() / 3);
  content.Node = [mesh](std::int64_t node) {
    return Point2{ mesh->XY[2 * std::size_t(node)], mesh->XY[2 * std::size_t(node) + 1] };
  };
  content.Corner = [mesh](std::int64_t triangle, int corner)
  { return mesh->Triangles[3 * std::size_t(triangle) + std::size_t(corner)]; };
  for (std::size_t i = 0; i < series.Variables.size(); ++i)
  {
    const SeriesVariable& variable = series.Variables[i];
    const auto reader = std::make_shared<ValueReader>(series, i);
    content.Arrays.push_back(
      { variable.Name, variable.LongName, variable.Units, floatFor(variable.Type), variable.OnCells,
        variable.Varies, [reader](std::size_t step) { return reader->read(step); } });
  }
  if (!mesh->OriginalCells.empty())
  {
    content.Arrays.push_back({ "OriginalCellId", "", "", Scalar::Int64, true, false,
      [mesh](std::size_t) { return mesh->OriginalCells.data(); } });
  }
  content.Times = series.Times;
  content.TimeUnits = series.TimeUnits;
  content.Calendar = series.Calendar;
  content.Crs = series.Crs;
  content.Source = series.Path;
  return content;
}

} // namespace tipp
