// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/PlainIds.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkTypeInt64Array.h"

namespace tipp
{
namespace
{

bool isPlain(vtkDataArray* array)
{
  switch (array->GetDataType())
  {
    case VTK_INT:
    case VTK_LONG:
    case VTK_LONG_LONG:
    case VTK_ID_TYPE:
      return array->HasStandardMemoryLayout();
    default:
      return false;
  }
}

vtkSmartPointer<vtkDataArray> wideCopy(vtkDataArray* array)
{
  const auto copy = vtkSmartPointer<vtkTypeInt64Array>::New();
  copy->DeepCopy(array);
  return copy;
}

} // namespace

PlainIds::PlainIds(vtkDataArray* array)
  : Array(!array || isPlain(array) ? vtkSmartPointer<vtkDataArray>(array) : wideCopy(array))
{
}

const void* PlainIds::data() const
{
  return this->Array ? this->Array->GetVoidPointer(0) : nullptr;
}

bool PlainIds::isWide() const
{
  return this->Array && this->Array->GetDataTypeSize() == sizeof(std::int64_t);
}

std::int64_t PlainIds::count() const
{
  return this->Array ? this->Array->GetNumberOfValues() : 0;
}

PlainIds PlainIds::widened() const
{
  PlainIds result = *this;
  if (!this->isWide() && this->Array)
  {
    result.Array = wideCopy(this->Array);
  }
  return result;
}

PlainCells::PlainCells(vtkCellArray* cells)
  : Offsets(cells->GetOffsetsArray())
  , Ids(cells->GetConnectivityArray())
{
  if (this->Offsets.isWide() != this->Ids.isWide())
  {
    this->Offsets = this->Offsets.widened();
    this->Ids = this->Ids.widened();
  }
}

} // namespace tipp
