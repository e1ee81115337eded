// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointsView_h
#define tippPointsView_h

#include "Predicates/Point2.h"

#include <cstddef>

namespace tipp
{

/// Points where they lie in memory: x and y are the first two of every `stride` scalars.
class PointsView
{
public:
  PointsView() = default;
  PointsView(const double* scalars, std::size_t count, std::size_t stride)
    : Doubles(scalars)
    , Count(count)
    , Stride(stride)
  {
  }
  PointsView(const float* scalars, std::size_t count, std::size_t stride)
    : Floats(scalars)
    , Count(count)
    , Stride(stride)
  {
  }

  std::size_t size() const { return this->Count; }

  Point2 operator[](std::size_t i) const
  {
    const std::size_t at = i * this->Stride;
    return this->Doubles ? Point2{ this->Doubles[at], this->Doubles[at + 1] }
                         : Point2{ this->Floats[at], this->Floats[at + 1] };
  }

  /// visit(index, point) for begin <= index < end, in order.
  template <typename Visit>
  void forEach(std::size_t begin, std::size_t end, Visit&& visit) const
  {
    if (this->Doubles)
    {
      scan(this->Doubles, this->Stride, begin, end, visit);
    }
    else
    {
      scan(this->Floats, this->Stride, begin, end, visit);
    }
  }

private:
  template <typename Scalar, typename Visit>
  static void scan(const Scalar* scalars,
    std::size_t stride,
    std::size_t begin,
    std::size_t end,
    Visit& visit)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      visit(i, Point2{ scalars[i * stride], scalars[i * stride + 1] });
    }
  }

  const double* Doubles = nullptr;
  const float* Floats = nullptr;
  std::size_t Count = 0;
  std::size_t Stride = 2;
};

} // namespace tipp

#endif
