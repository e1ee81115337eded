// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlainValues_h
#define tippPlainValues_h

#include "Arrays/Scalar.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <vector>

namespace tipp
{

/// The values of an array as consecutive doubles: the array's own memory if they are stored so,
/// else a copy.
class PlainValues
{
public:
  /// `array` must have values of a type that scalarOf() knows, and standard memory layout.
  explicit PlainValues(vtkDataArray* array)
    : Array(array)
  {
    if (array->GetDataType() == VTK_DOUBLE)
    {
      return;
    }
    withScalar(*scalarOf(array->GetDataType()),
      [&](auto type)
      {
        using T = decltype(type);
        const T* const values = static_cast<const T*>(array->GetVoidPointer(0));
        this->Copy.resize(std::size_t(array->GetNumberOfValues()));
        for (std::size_t i = 0; i < this->Copy.size(); ++i)
        {
          this->Copy[i] = double(values[i]);
        }
      });
  }

  const double* data() const
  {
    return this->Array->GetDataType() == VTK_DOUBLE
      ? static_cast<const double*>(this->Array->GetVoidPointer(0))
      : this->Copy.data();
  }

private:
  vtkSmartPointer<vtkDataArray> Array;
  std::vector<double> Copy;
};

} // namespace tipp

#endif
