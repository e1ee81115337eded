// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/CellArrays.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkGenericCell.h"
#include "vtkTypeInt64Array.h"

#include <array>

namespace tipp
{
namespace
{

bool isPlain(vtkDataArray* array)
{
  const int type = array->GetDataType();
  return array->HasStandardMemoryLayout() &&
    (type == VTK_INT || type == VTK_LONG || type == VTK_LONG_LONG || type == VTK_ID_TYPE);
}

vtkSmartPointer<vtkDataArray> wideCopy(vtkDataArray* array)
{
  const auto copy = vtkSmartPointer<vtkTypeInt64Array>::New();
  copy->DeepCopy(array);
  return copy;
}

} // namespace

vtkSmartPointer<vtkDataArray> contiguous(vtkDataArray* array)
{
  if (array->HasStandardMemoryLayout())
  {
    return array;
  }
  auto copy =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(array->GetDataType()));
  copy->DeepCopy(array);
  copy->SetName(array->GetName());
  return copy;
}

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

namespace
{

constexpr int unknown = -1;

/// The least number of vertices of a type whose number varies, else -1.
std::int64_t leastSize(int type)
{
  switch (type)
  {
    case VTK_POLY_VERTEX:
    case VTK_POLY_LINE:
      return 0;
    case VTK_TRIANGLE_STRIP:
    case VTK_POLYGON:
      return 3;
    case VTK_QUADRATIC_POLYGON:
      return 6;
    case VTK_CONVEX_POINT_SET:
    case VTK_POLYHEDRON:
      return 4;
    default:
      return type >= VTK_LAGRANGE_CURVE ? 0 : -1;
  }
}

std::array<int, 256> makeSizes()
{
  std::array<int, 256> sizes{};
  sizes.fill(unknown);
  for (int type = 0; type < VTK_NUMBER_OF_CELL_TYPES; ++type)
  {
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    if (cell)
    {
      sizes[std::size_t(type)] = leastSize(type) < 0 ? int(cell->GetNumberOfPoints()) : 0;
    }
  }
  sizes[VTK_EMPTY_CELL] = 0;
  return sizes;
}

int tabulated(int type)
{
  static const std::array<int, 256> sizes = makeSizes();
  return type >= 0 && type < 256 ? sizes[std::size_t(type)] : unknown;
}

/// Whether a higher-order cell can have this number of vertices, with the same order along all its
/// edges.
bool isHigherOrder(int type, std::int64_t size)
{
  for (std::int64_t n = 1; n <= size; ++n)
  {
    const std::int64_t triangle = (n + 1) * (n + 2) / 2;
    std::int64_t due = n + 1;
    switch (type)
    {
      case VTK_LAGRANGE_TRIANGLE:
      case VTK_BEZIER_TRIANGLE:
        due = n == 2 && size == 7 ? 7 : triangle;
        break;
      case VTK_LAGRANGE_QUADRILATERAL:
      case VTK_BEZIER_QUADRILATERAL:
        due = (n + 1) * (n + 1);
        break;
      case VTK_LAGRANGE_TETRAHEDRON:
      case VTK_BEZIER_TETRAHEDRON:
        due = n == 2 && size == 15 ? 15 : triangle * (n + 3) / 3;
        break;
      case VTK_LAGRANGE_HEXAHEDRON:
      case VTK_BEZIER_HEXAHEDRON:
        due = (n + 1) * (n + 1) * (n + 1);
        break;
      case VTK_LAGRANGE_WEDGE:
      case VTK_BEZIER_WEDGE:
        due = n == 2 && size == 21 ? 21 : triangle * (n + 1);
        break;
      default:
        break;
    }
    if (due >= size)
    {
      return due == size;
    }
  }
  return false;
}

} // namespace

bool isCellType(int type)
{
  return tabulated(type) != unknown;
}

int cellSizeOf(int type)
{
  return std::max(tabulated(type), 0);
}

bool isCellSize(int type, std::int64_t size)
{
  const int due = tabulated(type);
  if (due > 0 || due == unknown)
  {
    return size == due;
  }
  return type >= VTK_LAGRANGE_CURVE ? isHigherOrder(type, size) : size >= leastSize(type);
}

} // namespace tipp
