// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Scalar.h"

#include "vtkType.h"

namespace tipp
{
namespace
{

constexpr Scalar wholeNumber(std::size_t bytes, bool isSigned)
{
  switch (bytes)
  {
    case 1:
      return isSigned ? Scalar::Int8 : Scalar::UInt8;
    case 2:
      return isSigned ? Scalar::Int16 : Scalar::UInt16;
    case 4:
      return isSigned ? Scalar::Int32 : Scalar::UInt32;
    default:
      return isSigned ? Scalar::Int64 : Scalar::UInt64;
  }
}

} // namespace

std::optional<Scalar> scalarOf(int vtkType)
{
  switch (vtkType)
  {
    case VTK_FLOAT:
      return Scalar::Float32;
    case VTK_DOUBLE:
      return Scalar::Float64;
    case VTK_CHAR:
      return wholeNumber(1, char(-1) < 0);
    case VTK_SIGNED_CHAR:
      return Scalar::Int8;
    case VTK_UNSIGNED_CHAR:
      return Scalar::UInt8;
    case VTK_SHORT:
      return wholeNumber(sizeof(short), true);
    case VTK_UNSIGNED_SHORT:
      return wholeNumber(sizeof(short), false);
    case VTK_INT:
      return wholeNumber(sizeof(int), true);
    case VTK_UNSIGNED_INT:
      return wholeNumber(sizeof(int), false);
    case VTK_LONG:
      return wholeNumber(sizeof(long), true);
    case VTK_UNSIGNED_LONG:
      return wholeNumber(sizeof(long), false);
    case VTK_LONG_LONG:
      return Scalar::Int64;
    case VTK_UNSIGNED_LONG_LONG:
      return Scalar::UInt64;
    case VTK_ID_TYPE:
      return wholeNumber(sizeof(vtkIdType), true);
    default:
      return std::nullopt;
  }
}

int vtkTypeOf(Scalar type)
{
  constexpr int types[] = { VTK_TYPE_INT8, VTK_TYPE_UINT8, VTK_TYPE_INT16, VTK_TYPE_UINT16,
    VTK_TYPE_INT32, VTK_TYPE_UINT32, VTK_TYPE_INT64, VTK_TYPE_UINT64, VTK_TYPE_FLOAT32,
    VTK_TYPE_FLOAT64 };
  return types[int(type)];
}

} // namespace tipp
