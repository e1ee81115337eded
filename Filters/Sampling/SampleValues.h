// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleValues_h
#define tippSampleValues_h

#include "Arrays/Scalar.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace tipp
{

/// Sets the values [begin, end) of an array of this type to the null value.
inline void fillNull(Scalar type, double null, void* values, std::size_t begin, std::size_t end)
{
  withScalar(type,
    [&](auto zero)
    {
      using T = decltype(zero);
      std::fill(static_cast<T*>(values) + begin, static_cast<T*>(values) + end, toScalar<T>(null));
    });
}

/// Marks the points with a component equal to `value`. A float is compared with `value` rounded to
/// float; for integers, `value` may be out of the type's range.
inline void markEqual(
  Scalar type, const void* array, std::size_t components, double value, std::vector<bool>& marked)
{
  withScalar(type,
    [&](auto zero)
    {
      using T = decltype(zero);
      const T* const values = static_cast<const T*>(array);
      for (std::size_t i = 0; i < marked.size() * components; ++i)
      {
        const bool isEqual = std::is_floating_point_v<T> ? values[i] == toScalar<T>(value)
                                                         : double(values[i]) == value;
        marked[i / components] = marked[i / components] || isEqual;
      }
    });
}

/// Copies the first of `layers` layers of samples, which take `bytes` bytes together, to the
/// others.
inline void repeatLayer(void* samples, std::size_t bytes, std::size_t layers)
{
  char* const first = static_cast<char*>(samples);
  const std::size_t layer = bytes / layers;
  for (std::size_t i = 1; layer > 0 && i < layers; ++i)
  {
    std::memcpy(first + i * layer, first, layer);
  }
}

/// Sets `valid` to 1 at covered pixels, else to 0. Returns a warning if cells overlap, else an
/// empty text.
inline std::string markCovered(const std::vector<double>& shares, unsigned char* valid)
{
  std::transform(
    shares.begin(), shares.end(), valid, [](double share) { return (unsigned char)(share > 0); });
  const auto twice =
    std::count_if(shares.begin(), shares.end(), [](double share) { return share > 1; });
  return twice == 0 ? ""
                    : "Cells overlap: " + std::to_string(twice) +
      " pixels are covered more than once, and each of their cells counts.";
}

} // namespace tipp

#endif
