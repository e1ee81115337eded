// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputSurvey_h
#define tippInputSurvey_h

#include "Predicates/Geometry.h"
#include "Triangulation/StreamSampler.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
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
  Box2 Bounds = Box2::empty();       ///< of the finite points
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

/// Joins the surveys of all parts, in their order. The result does not depend on the division into
/// parts.
VTKTIPPFILTERS_EXPORT InputSurvey joinSurveys(std::vector<InputSurvey>& parts);

/// Sets the factor, and multiplies the bounds and the sample by it.
VTKTIPPFILTERS_EXPORT void applyFactor(InputSurvey& survey, double factor);

} // namespace tipp

#endif
