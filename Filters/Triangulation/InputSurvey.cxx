// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/InputSurvey.h"

#include "Triangulation/PointsView.h"

#include <algorithm>

namespace tipp
{

void applyFactor(InputSurvey& survey, double factor)
{
  survey.Factor = factor;
  survey.Bounds = scaled(survey.Bounds, factor);
  for (SampledPoint& p : survey.Sample)
  {
    p.Position = { p.Position.x * factor, p.Position.y * factor };
  }
}

InputSurvey joinSurveys(std::vector<InputSurvey>& parts)
{
  InputSurvey survey;
  CollinearityTest line;
  for (InputSurvey& part : parts)
  {
    survey.Points += part.Points;
    survey.Rejected += part.Rejected;
    survey.WithoutElevation += part.WithoutElevation;
    survey.Bounds.extend(part.Bounds);
    survey.Collinear = survey.Collinear && part.Collinear &&
      std::all_of(part.Line.begin(), part.Line.end(), [&](Point2 p) { return line.add(p); });
    survey.Sample.insert(survey.Sample.end(), part.Sample.begin(), part.Sample.end());
    std::vector<SampledPoint>().swap(part.Sample);
  }
  return survey;
}

} // namespace tipp
