// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputSurvey_h
#define tippInputSurvey_h

#include "Points/PointStream.h"
#include "Predicates/Box2.h"
#include "Predicates/Point2.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

struct SampledPoint
{
  std::int64_t Id; ///< its place in the stream
  Point2 Place;
};

/// What one pass over a stream tells.
struct InputSurvey
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0; ///< NaN or infinite coordinates
  Box2 Bounds{};             ///< of the finite points, times Factor
  double Factor = 1; ///< a power of two that brings coordinates near 1, where they are far from it
  bool Collinear = true;
  std::vector<SampledPoint> Sample; ///< times Factor; of finite points, by id
};

/// `blockPoints`: how many to read at a time. The sample has between `sample` and twice that many
/// points, one of each stretch of so many ids, picked at random but always the same.
VTKTIPPFILTERS_EXPORT InputSurvey surveyInput(PointStream& points, std::size_t blockPoints,
  std::size_t sample, int threads, const std::function<void(std::int64_t)>& progress);

} // namespace tipp

#endif
