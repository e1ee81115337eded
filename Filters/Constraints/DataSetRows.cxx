// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/DataSetRows.h"

#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{

Bytes packDataSet(vtkPolyData* data)
{
  vtkNew<vtkCharArray> buffer;
  if (!vtkCommunicator::MarshalDataObject(data, buffer))
  {
    throw std::runtime_error("The source cannot be sent to other ranks.");
  }
  const char* const begin = buffer->GetPointer(0);
  Bytes bytes(std::size_t(buffer->GetNumberOfValues()));
  std::copy_n(begin, bytes.size(), bytes.data());
  return bytes;
}

vtkSmartPointer<vtkPolyData> unpackDataSet(const Bytes& bytes)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  if (bytes.size() > 0)
  {
    vtkNew<vtkCharArray> buffer;
    buffer->SetNumberOfValues(vtkIdType(bytes.size()));
    std::copy_n(bytes.data(), bytes.size(), buffer->GetPointer(0));
    if (!vtkCommunicator::UnMarshalDataObject(buffer, data))
    {
      throw std::runtime_error("A part of the source that another rank has sent cannot be read.");
    }
  }
  return data;
}

vtkSmartPointer<vtkPolyData> copyRows(
  const std::vector<vtkSmartPointer<vtkPointSet>>& from, const std::vector<DataSetRow>& rows)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vtkIdType(rows.size()));
  vtkPointData* const data = result->GetPointData();
  vtkDataSetAttributes::FieldList fields;
  for (vtkPointSet* const one : from)
  {
    fields.IntersectFieldList(one->GetPointData());
  }
  data->CopyGlobalIdsOff();
  if (!from.empty())
  {
    fields.CopyAllocate(data, vtkDataSetAttributes::COPYTUPLE, vtkIdType(rows.size()), 0);
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    vtkPointSet* const set = from[rows[i].Set];
    points->SetPoint(vtkIdType(i), set->GetPoint(rows[i].Row));
    fields.CopyData(int(rows[i].Set), set->GetPointData(), rows[i].Row, data, vtkIdType(i));
  }
  result->SetPoints(points);
  return result;
}

} // namespace tipp
