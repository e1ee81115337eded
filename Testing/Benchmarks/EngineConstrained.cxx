// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"
#include "VtkData.h"

#include "Constraints/Insertion/TriangulateConstrained.h"

#include <vtkCellArray.h>
#include <vtkDelaunay2D.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

namespace tipp
{
namespace benchmark
{
namespace
{

/// The number of segments that are edges of triangles.
std::int64_t countEdges(vtkPolyData* mesh, const std::vector<Constraint>& segments)
{
  std::set<std::pair<vtkIdType, vtkIdType>> edges;
  vtkCellArray* const polys = mesh->GetPolys();
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < polys->GetNumberOfCells(); ++cell)
  {
    polys->GetCellAtId(cell, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    for (vtkIdType i = 0; i < count; ++i)
    {
      edges.insert(std::minmax({ ids->GetId(i), ids->GetId((i + 1) % count) }));
    }
  }
  return std::count_if(segments.begin(), segments.end(),
    [&edges](const Constraint& segment) {
      return edges.count(std::minmax<vtkIdType>({ segment.A, segment.B })) > 0;
    });
}

} // namespace

Run runConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments,
  const TriangulationOptions& options)
{
  Run run;
  const auto start = std::chrono::steady_clock::now();
  const ConstrainedTriangulation result = triangulateConstrained(
    PointsView(xy.data(), xy.size() / 2, 2), segments, CrossingRule::Split, options);
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Triangulation& mesh = result.Mesh;
  run.Triangles = std::int64_t(mesh.triangleCount());
  run.Statistics = mesh.Statistics;
  TriangleSum sum;
  const auto corner = [&](std::size_t i)
  { return &xy[2 * std::size_t(mesh.Ids32.empty() ? mesh.Ids64[i] : mesh.Ids32[i])]; };
  // Crossings have no coordinates in `xy`. If there are any, no checksum is computed.
  for (std::size_t t = 0; t < mesh.triangleCount() && result.Constraints.Crossings.empty(); ++t)
  {
    sum.add(corner(3 * t), corner(3 * t + 1), corner(3 * t + 2));
  }
  run.Checksum = sum.value();
  return run;
}

Run runVtkConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments)
{
  const vtkSmartPointer<vtkPolyData> input = toPolyData(xy);
  vtkNew<vtkCellArray> lines;
  for (const Constraint& segment : segments)
  {
    const vtkIdType ids[] = { segment.A, segment.B };
    lines->InsertNextCell(2, ids);
  }
  vtkNew<vtkPolyData> source;
  source->SetPoints(input->GetPoints());
  source->SetLines(lines);
  vtkNew<vtkDelaunay2D> filter;
  filter->SetInputData(input);
  filter->SetSourceData(source);
  filter->SetTolerance(0);
  Run run;
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  sumUp(filter->GetOutput(), run);
  run.Recovered = countEdges(filter->GetOutput(), segments);
  return run;
}

} // namespace benchmark
} // namespace tipp
