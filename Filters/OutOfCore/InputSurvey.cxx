// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/InputSurvey.h"

#include "Points/PointTable.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointSurvey.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <utility>

namespace tipp
{

/// Returns the factor of withModerateMagnitude(), or 1 unless it is exact for each block.
double factorOfPart(PointStream& points, std::size_t blockPoints, const Box2& bounds)
{
  double factor = withModerateMagnitude(PointsView(), bounds).factor();
  forEachBlock(points, blockPoints,
    [&](PointBlock& block)
    {
      const PointsView view(block.XY.data(), block.size(), 2);
      factor = factor == 1 ? 1 : withModerateMagnitude(view, bounds).factor();
    });
  return factor;
}

bool mayNeedFactor(const InputSurvey& survey)
{
  return survey.Points > survey.Rejected &&
    withModerateMagnitude(PointsView(), survey.Bounds).factor() != 1;
}

void applyFactor(InputSurvey& survey, double factor)
{
  survey.Factor = factor;
  survey.Bounds = scaled(survey.Bounds, factor);
  for (SampledPoint& p : survey.Sample)
  {
    p.Position = { p.Position.x * factor, p.Position.y * factor };
  }
}

InputSurvey surveyPart(PointStream& points, const PassOptions& options)
{
  InputSurvey survey;
  StreamSampler<Point2> sampler(options.SamplePoints, points.divisible());
  CollinearityTest line;
  const std::size_t elevation = findElevation(points.columns());
  forEachBlock(points, options.BlockPoints,
    [&](PointBlock& block)
    {
      const PointsView view(block.XY.data(), block.size(), 2);
      const PointSurvey part = surveyPoints(view, options.Threads);
      survey.Bounds = unionOf(survey.Bounds, part.Bounds);
      survey.Rejected += std::int64_t(part.Rejected.size());
      survey.WithoutElevation +=
        elevation < block.Columns.size() ? countMissing(block.Columns[elevation]) : 0;
      sampler.add(block.First, view);
      for (std::size_t i = 0; survey.Collinear && i < view.size(); ++i)
      {
        survey.Collinear = line.add(view[i]);
      }
      survey.Points += std::int64_t(block.size());
      options.Progress(survey.Points);
    });
  survey.Line = line.line();
  survey.Sample = sampler.take();
  return survey;
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
    survey.Bounds = unionOf(survey.Bounds, part.Bounds);
    survey.Collinear = survey.Collinear && part.Collinear &&
      std::all_of(part.Line.begin(), part.Line.end(), [&](Point2 p) { return line.add(p); });
    survey.Sample.insert(survey.Sample.end(), part.Sample.begin(), part.Sample.end());
    std::vector<SampledPoint>().swap(part.Sample);
  }
  return survey;
}

} // namespace tipp
