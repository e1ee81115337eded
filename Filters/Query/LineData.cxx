// SPDX-License-Identifier: BSD-3-Clause
#include "Query/LineData.h"

#include "Arrays/Scalar.h"
#include "Query/QueryArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <cstdint>
#include <vector>

namespace tipp
{
namespace
{

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<Point3>& positions)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vtkIdType(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points->SetPoint(vtkIdType(i), positions[i].x, positions[i].y, positions[i].z);
  }
  return points;
}

/// Creates a line for each list of successive points, none of which is empty. VTK crashes on a line
/// of one point (vtkPolyData::GetCellType in 9.1), so such a line has its point twice.
vtkSmartPointer<vtkPolyData> linesOf(
  const std::vector<Point3>& positions, const std::vector<std::int64_t>& starts, bool isClosed)
{
  vtkNew<vtkCellArray> lines;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
  {
    const std::int64_t count = starts[i + 1] - starts[i];
    const bool repeatsFirst = isClosed || count == 1;
    lines->InsertNextCell(int(count) + (repeatsFirst ? 1 : 0));
    for (std::int64_t at = starts[i]; at < starts[i + 1]; ++at)
    {
      lines->InsertCellPoint(at);
    }
    repeatsFirst ? lines->InsertCellPoint(starts[i]) : void();
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(positions));
  data->SetLines(lines);
  return data;
}

} // namespace

vtkSmartPointer<vtkDataArray> takeOver(MeshAnswer::Array& values)
{
  auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeOf(values.Type)));
  const auto count = vtkIdType(values.Values.size() / scalarSize(values.Type));
  array->SetName(values.Name.c_str());
  array->SetNumberOfComponents(values.Components);
  array->SetVoidArray(values.Values.release(), count, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  return array;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const BoundaryLoops& loops)
{
  vtkSmartPointer<vtkPolyData> data = linesOf(loops.Positions, loops.Points.Starts, true);
  data->GetPointData()->SetGlobalIds(arrayOf<vtkIdTypeArray>("GlobalPointIds", loops.Points.Ids));
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const Contours& contours, const std::string& name)
{
  vtkSmartPointer<vtkPolyData> data = linesOf(contours.Points, contours.Starts, false);
  data->GetCellData()->SetScalars(arrayOf<vtkDoubleArray>(name.c_str(), contours.Levels));
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const Descents& descents, const std::string& name)
{
  std::vector<std::int64_t> starts = { 0 };
  std::vector<std::int64_t> numbers;
  std::vector<std::int64_t> pits;
  for (std::size_t i = 0; i < descents.Pits.size(); ++i)
  {
    if (descents.Starts[i + 1] > descents.Starts[i])
    {
      starts.push_back(descents.Starts[i + 1]);
      numbers.push_back(std::int64_t(i));
      pits.push_back(descents.Pits[i]);
    }
  }
  vtkSmartPointer<vtkPolyData> data = linesOf(descents.Points, starts, false);
  data->GetCellData()->AddArray(arrayOf<vtkIdTypeArray>("StartId", numbers));
  data->GetCellData()->AddArray(arrayOf<vtkIdTypeArray>("PitId", pits));
  data->GetPointData()->SetScalars(arrayOf<vtkDoubleArray>(name.c_str(), descents.Values));
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(Profile&& profile)
{
  const auto count = std::int64_t(profile.Points.size());
  vtkSmartPointer<vtkPolyData> data = linesOf(profile.Points,
    count > 0 ? std::vector<std::int64_t>{ 0, count } : std::vector<std::int64_t>{ 0 }, false);
  vtkPointData* const values = data->GetPointData();
  values->AddArray(arrayOf<vtkDoubleArray>("Distance", profile.Distances));
  values->AddArray(arrayOf<vtkIdTypeArray>("CellId", profile.Answer.Cells));
  for (MeshAnswer::Array& array : profile.Answer.Arrays)
  {
    values->AddArray(takeOver(array));
  }
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(StayingAnswer&& answer)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(answer.Points));
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < vtkIdType(answer.Points.size()); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  data->SetVerts(vertices);
  vtkPointData* const values = data->GetPointData();
  for (MeshAnswer::Array& array : answer.Answer.Arrays)
  {
    values->AddArray(takeOver(array));
  }
  values->AddArray(arrayOf<vtkIdTypeArray>("CellId", answer.Answer.Cells));
  values->AddArray(arrayOf<vtkIdTypeArray>("AskingRank", answer.Ranks));
  values->AddArray(arrayOf<vtkIdTypeArray>("AskingId", answer.Indices));
  return data;
}

} // namespace tipp
