// SPDX-License-Identifier: BSD-3-Clause
#include "Series/StepReader.h"
#include "Series/WriteUgrid.h"

#include <memory>

namespace tipp
{

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
    const auto reader = std::make_shared<StepReader>(series, i, 1, false);
    content.Arrays.push_back({ variable.Name, variable.LongName, variable.Units, reader->type(),
      variable.OnCells, variable.Varies, [reader](std::size_t step) { return reader->read(step); },
      variable.StandardName });
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
