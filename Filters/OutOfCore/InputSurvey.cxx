// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/InputSurvey.h"

#include "Arrays/Random.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointSurvey.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

constexpr Box2 nothing{ HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL };

/// Picks one point of each range of ids; ranges double in length until there are few enough. Picks
/// at equal distances would hit one column of a lattice that is given row by row. If the number of
/// all points is known, a part of the stream has the same picks as in the whole.
class Sampler
{
public:
  /// `points`: of all, or -1.
  Sampler(std::size_t atLeast, std::int64_t points)
    : Most(2 * std::int64_t(std::max<std::size_t>(atLeast, 1)))
    , IsKnown(points >= 0)
  {
    while (this->IsKnown && this->pick(this->Most - 1, this->Doublings) < points)
    {
      ++this->Doublings;
    }
  }

  void add(std::int64_t first, PointsView points)
  {
    const std::int64_t end = first + std::int64_t(points.size());
    this->Range = std::max(this->Range, first >> this->Doublings);
    for (std::int64_t id = this->next(); id < end; id = this->next())
    {
      ++this->Range;
      if (id < first)
      {
        continue; // of another part
      }
      this->Picks.push_back({ id, points[std::size_t(id - first)] });
      if (!this->IsKnown && this->Range == this->Most)
      {
        this->halve();
      }
    }
  }

  std::vector<SampledPoint> take()
  {
    this->Picks.erase(std::remove_if(this->Picks.begin(), this->Picks.end(),
                        [](const SampledPoint& p) { return !isFinite(p.Position); }),
      this->Picks.end());
    return std::move(this->Picks);
  }

private:
  std::int64_t next() const { return this->pick(this->Range, this->Doublings); }

  static std::int64_t chosenOf(std::int64_t pair) { return 2 * pair + (mixBits(pair) & 1); }

  /// The id picked for a range after this many doublings. For the first ranges it was picked when
  /// they were shorter.
  std::int64_t pick(std::int64_t range, int doublings) const
  {
    while (doublings > 0 && range < this->Most / 2)
    {
      range = chosenOf(range);
      --doublings;
    }
    const std::int64_t length = std::int64_t(1) << doublings;
    return range * length +
      std::int64_t(mixBits(std::uint64_t(range * 64 + doublings)) % std::uint64_t(length));
  }

  void halve()
  {
    const std::int64_t half = this->Most / 2;
    for (std::int64_t i = 0; i < half; ++i)
    {
      this->Picks[std::size_t(i)] = this->Picks[std::size_t(chosenOf(i))];
    }
    this->Picks.resize(std::size_t(half));
    this->Range = half;
    ++this->Doublings;
  }

  const std::int64_t Most;
  const bool IsKnown;
  std::vector<SampledPoint> Picks;
  std::int64_t Range = 0; ///< the next one
  int Doublings = 0;
};

} // namespace

/// withModerateMagnitude's, if it is exact for each block.
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
  survey.Bounds = { survey.Bounds.xmin * factor, survey.Bounds.ymin * factor,
    survey.Bounds.xmax * factor, survey.Bounds.ymax * factor };
  for (SampledPoint& p : survey.Sample)
  {
    p.Position = { p.Position.x * factor, p.Position.y * factor };
  }
}

PartialSurvey surveyPart(PointStream& points, std::size_t blockPoints, std::size_t sample,
  int threads, const std::function<void(std::int64_t)>& progress)
{
  PartialSurvey survey;
  survey.Bounds = nothing;
  Sampler sampler(sample, points.divisible());
  CollinearityTest line;
  forEachBlock(points, blockPoints,
    [&](PointBlock& block)
    {
      const PointsView view(block.XY.data(), block.size(), 2);
      const PointSurvey part = surveyPoints(view, threads);
      survey.Bounds = unionOf(survey.Bounds, part.Bounds);
      survey.Rejected += std::int64_t(part.Rejected.size());
      sampler.add(block.First, view);
      for (std::size_t i = 0; survey.Collinear && i < view.size(); ++i)
      {
        survey.Collinear = line.add(view[i]);
      }
      survey.Points += std::int64_t(block.size());
      progress(survey.Points);
    });
  survey.Line = line.line();
  survey.Sample = sampler.take();
  return survey;
}

InputSurvey joinSurveys(std::vector<PartialSurvey>& parts)
{
  InputSurvey survey;
  survey.Bounds = nothing;
  CollinearityTest line;
  for (PartialSurvey& part : parts)
  {
    survey.Points += part.Points;
    survey.Rejected += part.Rejected;
    survey.Bounds = unionOf(survey.Bounds, part.Bounds);
    survey.Collinear = survey.Collinear && part.Collinear &&
      std::all_of(part.Line.begin(), part.Line.end(), [&](Point2 p) { return line.add(p); });
    survey.Sample.insert(survey.Sample.end(), part.Sample.begin(), part.Sample.end());
    std::vector<SampledPoint>().swap(part.Sample);
  }
  return survey;
}

} // namespace tipp
