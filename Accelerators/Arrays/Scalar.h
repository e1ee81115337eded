// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScalar_h
#define tippScalar_h

#include "vtkTIPPAcceleratorsModule.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>

namespace tipp
{

/// The type of an array's values.
enum class Scalar
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

/// Calls work(value) with a value of the corresponding C++ type.
template <typename Work>
void withScalar(Scalar type, const Work& work)
{
  // NOLINTBEGIN(bugprone-branch-clone): the types differ.
  switch (type)
  {
    case Scalar::Int8:
      return work(std::int8_t());
    case Scalar::UInt8:
      return work(std::uint8_t());
    case Scalar::Int16:
      return work(std::int16_t());
    case Scalar::UInt16:
      return work(std::uint16_t());
    case Scalar::Int32:
      return work(std::int32_t());
    case Scalar::UInt32:
      return work(std::uint32_t());
    case Scalar::Int64:
      return work(std::int64_t());
    case Scalar::UInt64:
      return work(std::uint64_t());
    case Scalar::Float32:
      return work(float());
    case Scalar::Float64:
      return work(double());
  }
  // NOLINTEND(bugprone-branch-clone)
}

/// Converts a number to the nearest value of a type; NaN becomes 0 in integer types.
template <typename T>
T toScalar(double value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return T(value);
  }
  else
  {
    if (std::isnan(value))
    {
      return 0;
    }
    // The largest integer rounds up if it has more digits than a double.
    if (value >= double(std::numeric_limits<T>::max()))
    {
      return std::numeric_limits<T>::max();
    }
    if (value <= double(std::numeric_limits<T>::lowest()))
    {
      return std::numeric_limits<T>::lowest();
    }
    return T(std::nearbyint(value));
  }
}

/// The Scalar of a VTK_... type; nullopt for bits and types that are not numeric.
VTKTIPPACCELERATORS_EXPORT std::optional<Scalar> scalarOf(int vtkType);

/// The inverse of scalarOf().
VTKTIPPACCELERATORS_EXPORT int vtkTypeOf(Scalar type);

} // namespace tipp

#endif
