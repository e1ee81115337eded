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

/// The result of the first pass over a stream.
struct InputSurvey
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;         ///< points with NaN or infinite coordinates
  std::int64_t WithoutElevation = 0; ///< points whose elevation is NaN or infinite
  Box2 Bounds{};                     ///< of the finite points; coordinates times Factor
  /// A power of two that brings very small or large coordinates to about 1; else 1.
  double Factor = 1;
  /// Whether all finite points are on one line.
  bool Collinear = true;
  std::vector<SampledPoint> Sample; ///< finite points, ascending ids; coordinates times Factor
};

/// The result of a first pass over a part of the stream. Coordinates are not scaled.
struct PartialSurvey
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;
  std::int64_t WithoutElevation = 0;
  Box2 Bounds{};
  bool Collinear = true;
  std::vector<Point2> Line; ///< if collinear: at most two points of the line
  std::vector<SampledPoint> Sample;
};

template <typename Archive>
void serialize(Archive& archive, PartialSurvey& part)
{
  archive(part.Points, part.Rejected, part.WithoutElevation, part.Bounds, part.Collinear, part.Line,
    part.Sample);
}

/// Surveys the points of the stream, `blockPoints` at a time. The sample of all parts together has
/// between `sample` and twice as many points: one from each range of ids of equal length, chosen at
/// random but always the same. Throws IOError.
VTKTIPPFILTERS_EXPORT PartialSurvey surveyPart(PointStream& points, std::size_t blockPoints,
  std::size_t sample, int threads, const std::function<void(std::int64_t)>& progress);

/// Joins the surveys of all parts, in their order; Factor is 1. The result does not depend on the
/// division into parts.
VTKTIPPFILTERS_EXPORT InputSurvey joinSurveys(std::vector<PartialSurvey>& parts);

/// Returns the InputSurvey::Factor that is exact for all points of a part; 1 if there is none.
/// Reads the part. `bounds`: of all points, not scaled. Throws IOError.
VTKTIPPFILTERS_EXPORT double factorOfPart(
  PointStream& points, std::size_t blockPoints, const Box2& bounds);
/// Returns whether the bounds call for a factor other than 1.
VTKTIPPFILTERS_EXPORT bool mayNeedFactor(const InputSurvey& survey);
/// Sets the factor, and multiplies the bounds and the sample by it.
VTKTIPPFILTERS_EXPORT void applyFactor(InputSurvey& survey, double factor);

} // namespace tipp

#endif
