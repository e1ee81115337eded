// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputSurvey_h
#define tippInputSurvey_h

#include "OutOfCore/StreamSampler.h"
#include "Points/PointStream.h"
#include "Predicates/Points.h"
#include "vtkTIPPFiltersModule.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

using SampledPoint = SampledPointOf<Point2>;

/// The result of the first pass over a stream or a part of it. Coordinates are multiplied by
/// Factor.
struct InputSurvey
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;         ///< points with NaN or infinite coordinates
  std::int64_t WithoutElevation = 0; ///< points whose elevation is NaN or infinite
  Box2 Bounds{ HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL }; ///< of the finite points
  /// A power of two that brings very small or large coordinates to about 1; else 1.
  double Factor = 1;
  /// Whether all finite points are on one line.
  bool Collinear = true;
  std::vector<Point2> Line;         ///< of a part, if collinear: at most two points of the line
  std::vector<SampledPoint> Sample; ///< finite points, ascending ids
};

template <typename Archive>
void serialize(Archive& archive, InputSurvey& part)
{
  archive(part.Points, part.Rejected, part.WithoutElevation, part.Bounds, part.Factor,
    part.Collinear, part.Line, part.Sample);
}

/// How a rank reads its part of the input.
struct PassOptions
{
  std::size_t BlockPoints;  ///< points per read
  std::size_t SamplePoints; ///< smallest size of the sample of all parts together
  int Threads;
  /// Called with the number of finished points of a part.
  std::function<void(std::int64_t)> Progress;
};

/// Surveys the points of the stream; Factor is 1. The sample of all parts together has at most
/// twice as many points as SamplePoints: one from each range of ids of equal length, chosen at
/// random but always the same. Throws IOError.
VTKTIPPFILTERS_EXPORT InputSurvey surveyPart(PointStream& points, const PassOptions& options);

/// Joins the surveys of all parts, in their order. The result does not depend on the division into
/// parts.
VTKTIPPFILTERS_EXPORT InputSurvey joinSurveys(std::vector<InputSurvey>& parts);

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
