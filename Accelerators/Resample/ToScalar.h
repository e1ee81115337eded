// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippToScalar_h
#define tippToScalar_h

#include <cmath>
#include <limits>
#include <type_traits>

namespace tipp
{

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

} // namespace tipp

#endif
