// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputSurvey_h
#define tippInputSurvey_h

#include "OutOfCore/StreamSampler.h"
#include "Points/PointStream.h"
#include "Predicates/Points.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

using SampledPoint = SampledPointOf<Point2>;

/// The result of one pass over a stream.
struct InputSurvey
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;         ///< NaN or infinite coordinates
  std::int64_t WithoutElevation = 0; ///< it is NaN or infinite
  Box2 Bounds{};                     ///< of the finite points, times Factor
  double Factor = 1; ///< a power of two that brings coordinates near 1, where they are far from it
  bool Collinear = true;
  std::vector<SampledPoint> Sample; ///< times Factor; of finite points, by id
};

/// The result of a pass over a part of the stream; coordinates are not scaled.
struct PartialSurvey
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;
  std::int64_t WithoutElevation = 0;
  Box2 Bounds{};
  bool Collinear = true;
  std::vector<Point2> Line; ///< two of them or fewer, if collinear
  std::vector<SampledPoint> Sample;
};

/// Reads `blockPoints` points at a time. The sample of all parts has between `sample` and twice
/// that many points, one for each range of ids of equal length: random, but the same in every run.
VTKTIPPFILTERS_EXPORT PartialSurvey surveyPart(PointStream& points, std::size_t blockPoints,
  std::size_t sample, int threads, const std::function<void(std::int64_t)>& progress);

/// Joins the surveys of all parts, in their order, without the factor. The result does not depend
/// on how the stream was divided.
VTKTIPPFILTERS_EXPORT InputSurvey joinSurveys(std::vector<PartialSurvey>& parts);

/// Returns the InputSurvey::Factor that a part allows; 1 if any is allowed.
VTKTIPPFILTERS_EXPORT double factorOfPart(
  PointStream& points, std::size_t blockPoints, const Box2& bounds);
VTKTIPPFILTERS_EXPORT bool mayNeedFactor(const InputSurvey& survey);
VTKTIPPFILTERS_EXPORT void applyFactor(InputSurvey& survey, double factor);

} // namespace tipp

#endif
