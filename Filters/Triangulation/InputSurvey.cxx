// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/InputSurvey.h"

#include "Triangulation/PointsView.h"

namespace tipp
{

template <int D>
void applyFactor(InputSurveyOf<D>& survey, double factor)
{
  survey.Factor = factor;
  survey.Bounds = scaled(survey.Bounds, factor);
  for (SampledPointOf<Point<D>>& p : survey.Sample)
  {
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      p.Position[axis] *= factor;
    }
  }
}

template <int D>
InputSurveyOf<D> joinSurveys(std::vector<InputSurveyOf<D>>& parts)
{
  InputSurveyOf<D> survey;
  DimensionTest<D> dimension;
  for (InputSurveyOf<D>& part : parts)
  {
    survey.Points += part.Points;
    survey.Rejected += part.Rejected;
    survey.WithoutElevation += part.WithoutElevation;
    survey.LeftOut += part.LeftOut;
    survey.ThinnedOut += part.ThinnedOut;
    survey.Bounds.extend(part.Bounds);
    for (const Point<D>& p : part.Simplex)
    {
      dimension.add(p);
    }
    survey.Sample.insert(survey.Sample.end(), part.Sample.begin(), part.Sample.end());
    std::vector<SampledPointOf<Point<D>>>().swap(part.Sample);
  }
  survey.Simplex = dimension.simplex();
  return survey;
}

template InputSurveyOf<2> joinSurveys(std::vector<InputSurveyOf<2>>& parts);
template InputSurveyOf<3> joinSurveys(std::vector<InputSurveyOf<3>>& parts);
template void applyFactor(InputSurveyOf<2>& survey, double factor);
template void applyFactor(InputSurveyOf<3>& survey, double factor);

} // namespace tipp
