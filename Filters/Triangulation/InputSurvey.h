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

/// The result of the first pass over a stream or a part of it, in D dimensions. Coordinates are
/// multiplied by Factor.
template <int D>
struct InputSurveyOf
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;         ///< points with NaN or infinite coordinates
  std::int64_t WithoutElevation = 0; ///< in the plane: points whose elevation is NaN or infinite
  std::int64_t LeftOut = 0;          ///< points that the input's options exclude
  std::int64_t ThinnedOut = 0;       ///< points that thinning removed
  Box<D> Bounds = Box<D>::empty();   ///< of the finite points
  /// A power of two that brings very small or large coordinates to about 1; else 1.
  double Factor = 1;
  /// The finite points' DimensionTest::simplex(); not multiplied by Factor.
  std::vector<Point<D>> Simplex;
  std::vector<SampledPointOf<Point<D>>> Sample; ///< finite points, ascending ids

  /// Returns the number of finite points.
  std::int64_t finite() const { return this->Points - this->Rejected; }
  /// Returns the dimension of the finite points, see DimensionTest.
  int dimension() const { return int(this->Simplex.size()) - 1; }
};

using InputSurvey = InputSurveyOf<2>;
using InputSurvey3 = InputSurveyOf<3>;

template <typename Archive, int D>
void serialize(Archive& archive, InputSurveyOf<D>& part)
{
  archive(part.Points, part.Rejected, part.WithoutElevation, part.LeftOut, part.ThinnedOut,
    part.Bounds, part.Factor, part.Simplex, part.Sample);
}

/// Joins the surveys of all parts, in their order. The result does not depend on the division into
/// parts, except for Simplex, whose size does not.
template <int D>
VTKTIPPFILTERS_EXPORT InputSurveyOf<D> joinSurveys(std::vector<InputSurveyOf<D>>& parts);

/// Sets the factor, and multiplies the bounds and the sample by it.
template <int D>
VTKTIPPFILTERS_EXPORT void applyFactor(InputSurveyOf<D>& survey, double factor);

} // namespace tipp

#endif
