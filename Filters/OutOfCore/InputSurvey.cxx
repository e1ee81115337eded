// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/InputSurvey.h"

#include "Triangulation/DegenerateInput.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

std::uint64_t mix(std::uint64_t x) // the finaliser of splitmix64
{
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// One point of each stretch of ids; stretches double whenever there are too many. Regular picks
/// would see one column of a lattice that comes row by row.
class Sampler
{
public:
  explicit Sampler(std::size_t atLeast)
    : Most(2 * std::max<std::size_t>(atLeast, 1))
  {
  }

  void add(std::int64_t first, PointsView points)
  {
    const std::int64_t end = first + std::int64_t(points.size());
    while (this->Next < end)
    {
      this->Picks.push_back({ this->Next, points[std::size_t(this->Next - first)] });
      if (this->Picks.size() == this->Most)
      {
        this->halve();
      }
      const auto stretch = std::int64_t(this->Picks.size());
      this->Next = stretch * this->Stretch +
        std::int64_t(
          mix(std::uint64_t(stretch * 64 + this->Doublings)) % std::uint64_t(this->Stretch));
    }
  }

  std::vector<SampledPoint> take()
  {
    this->Picks.erase(std::remove_if(this->Picks.begin(), this->Picks.end(),
                        [](const SampledPoint& p) { return !isFinite(p.Place); }),
      this->Picks.end());
    return std::move(this->Picks);
  }

private:
  void halve()
  {
    for (std::size_t i = 0; i < this->Most / 2; ++i)
    {
      this->Picks[i] = this->Picks[2 * i + (mix(i) & 1)];
    }
    this->Picks.resize(this->Most / 2);
    this->Stretch *= 2;
    ++this->Doublings;
  }

  const std::size_t Most;
  std::vector<SampledPoint> Picks;
  std::int64_t Stretch = 1;
  std::int64_t Doublings = 0;
  std::int64_t Next = 0;
};

/// A factor for all points: withModerateMagnitude's, if it is exact for each block.
double factorFor(PointStream& points, std::size_t blockPoints, const Box2& bounds)
{
  double factor = withModerateMagnitude(PointsView(), bounds).factor();
  if (factor != 1)
  {
    forEachBlock(points, blockPoints,
      [&](PointBlock& block)
      {
        const PointsView view(block.XY.data(), block.size(), 2);
        factor = factor == 1 ? 1 : withModerateMagnitude(view, bounds).factor();
      });
  }
  return factor;
}

} // namespace

InputSurvey surveyInput(PointStream& points, std::size_t blockPoints, std::size_t sample,
  int threads, const std::function<void(std::int64_t)>& progress)
{
  InputSurvey survey;
  survey.Bounds = { HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  Sampler sampler(sample);
  CollinearityTest line;
  forEachBlock(points, blockPoints,
    [&](PointBlock& block)
    {
      const PointsView view(block.XY.data(), block.size(), 2);
      const PointSurvey part = surveyPoints(view, threads);
      survey.Bounds.xmin = std::min(survey.Bounds.xmin, part.Bounds.xmin);
      survey.Bounds.ymin = std::min(survey.Bounds.ymin, part.Bounds.ymin);
      survey.Bounds.xmax = std::max(survey.Bounds.xmax, part.Bounds.xmax);
      survey.Bounds.ymax = std::max(survey.Bounds.ymax, part.Bounds.ymax);
      survey.Rejected += std::int64_t(part.Rejected.size());
      sampler.add(block.First, view);
      for (std::size_t i = 0; survey.Collinear && i < view.size(); ++i)
      {
        survey.Collinear = line.add(view[i]);
      }
      survey.Points = block.First + std::int64_t(block.size());
      progress(survey.Points);
    });
  survey.Sample = sampler.take();
  if (survey.Points > survey.Rejected)
  {
    survey.Factor = factorFor(points, blockPoints, survey.Bounds);
  }
  const double factor = survey.Factor;
  survey.Bounds = { survey.Bounds.xmin * factor, survey.Bounds.ymin * factor,
    survey.Bounds.xmax * factor, survey.Bounds.ymax * factor };
  for (SampledPoint& p : survey.Sample)
  {
    p.Place = { p.Place.x * factor, p.Place.y * factor };
  }
  return survey;
}

} // namespace tipp
