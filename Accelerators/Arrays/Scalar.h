// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScalar_h
#define tippScalar_h

#include "vtkTIPPAcceleratorsModule.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
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

/// The C++ types of the enumerators, in their order.
using ScalarTypes = std::tuple<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
  std::uint32_t, std::int64_t, std::uint64_t, float, double>;

/// Calls work(value) with a value of the type's C++ type.
template <std::size_t I = 0, typename Work>
void withScalar(Scalar type, const Work& work)
{
  if constexpr (I < std::tuple_size_v<ScalarTypes>)
  {
    std::size_t(type) == I ? work(std::tuple_element_t<I, ScalarTypes>())
                           : withScalar<I + 1>(type, work);
  }
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

/// Converts an interpolated value as VTK does: an integer type gets the nearest integer, a half
/// away from 0.
template <typename T>
T roundedLikeVtk(double value)
{
  return toScalar<T>(std::is_integral_v<T> ? std::trunc(value + std::copysign(0.5, value)) : value);
}

/// The Scalar of a VTK_... type constant; nullopt for VTK_BIT and non-numeric types.
VTKTIPPACCELERATORS_EXPORT std::optional<Scalar> scalarOf(int vtkType);

/// The inverse of scalarOf().
VTKTIPPACCELERATORS_EXPORT int vtkTypeOf(Scalar type);

} // namespace tipp

#endif
