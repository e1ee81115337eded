// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputSurvey_h
#define tippInputSurvey_h

#include "Points/PointStream.h"
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
  Point2 Position;
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

/// What a pass over a part of the stream tells; coordinates as they are.
struct PartSurvey
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;
  Box2 Bounds{};
  bool Collinear = true;
  std::vector<Point2> Line; ///< two of them or fewer, if collinear
  std::vector<SampledPoint> Sample;
};

/// `blockPoints`: how many to read at a time. The sample of all parts has between `sample` and
/// twice that many points, one of each stretch of so many ids, picked at random but always the
/// same.
VTKTIPPFILTERS_EXPORT PartSurvey surveyPart(PointStream& points, std::size_t blockPoints,
  std::size_t sample, int threads, const std::function<void(std::int64_t)>& progress);

/// Of all parts, in their order, but for the factor; the same however the stream was cut.
VTKTIPPFILTERS_EXPORT InputSurvey joinSurveys(std::vector<PartSurvey>& parts);

/// What a part allows InputSurvey::Factor to be: 1 where any does.
VTKTIPPFILTERS_EXPORT double factorOfPart(
  PointStream& points, std::size_t blockPoints, const Box2& bounds);
VTKTIPPFILTERS_EXPORT bool mayNeedFactor(const InputSurvey& survey);
VTKTIPPFILTERS_EXPORT void applyFactor(InputSurvey& survey, double factor);

} // namespace tipp

#endif
