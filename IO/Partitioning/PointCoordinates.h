// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointCoordinates_h
#define tippPointCoordinates_h

#include "Flat/RawArray.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace tipp
{

template <typename Value>
void takeCoordinatesAs(
  const char* raw, std::size_t count, int components, int dimension, double* to)
{
  Value tuple[3] = {};
  for (std::size_t i = 0; i < count; ++i)
  {
    std::memcpy(tuple, raw, std::size_t(components) * sizeof(Value));
    raw += std::size_t(components) * sizeof(Value);
    for (int axis = 0; axis < dimension; ++axis)
    {
      *to++ = double(tuple[axis]);
    }
  }
}

/// Copies the first `dimension` coordinates of points as a file stores them; missing ones are 0.
inline void takeCoordinates(
  const RawArray& points, const char* raw, std::size_t count, int dimension, double* to)
{
  const int components = std::min(points.Components, 3);
  if (points.Type == Scalar::Float32)
  {
    takeCoordinatesAs<float>(raw, count, components, dimension, to);
  }
  else
  {
    takeCoordinatesAs<double>(raw, count, components, dimension, to);
  }
}

} // namespace tipp

#endif
