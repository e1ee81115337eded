// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Scalar.h"

#include "vtkSetGet.h"
#include "vtkType.h"

namespace tipp
{
namespace
{

template <typename T, std::size_t I = 0>
constexpr Scalar scalarLike()
{
  using Listed = std::tuple_element_t<I, ScalarTypes>;
  if constexpr (sizeof(T) == sizeof(Listed) && std::is_signed_v<T> == std::is_signed_v<Listed> &&
    std::is_integral_v<T> == std::is_integral_v<Listed>)
  {
    return Scalar(I);
  }
  else
  {
    return scalarLike<T, I + 1>();
  }
}

} // namespace

std::optional<Scalar> scalarOf(int vtkType)
{
  switch (vtkType)
  {
    vtkTemplateMacro(return scalarLike<VTK_TT>());
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
