// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/Survey.h"

#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointSurvey.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
namespace
{

/// What a rank sends to the first rank about its points. Two points represent a rank's points if
/// these are collinear.
struct RankSurvey
{
  Box2 Bounds;
  Point2 Ends[2];
  std::int64_t Finite;
  std::int64_t IsCollinear;
};

struct Verdict
{
  Box2 Bounds;
  std::int64_t IsCollinear;
};

void findEnds(PointsView points, Point2 (&ends)[2])
{
  bool found = false;
  points.forEach(0, points.size(),
    [&](std::size_t, Point2 p)
    {
      if (!isFinite(p))
      {
        return;
      }
      ends[0] = !found || lexicographicLess(p, ends[0]) ? p : ends[0];
      ends[1] = !found || lexicographicLess(ends[1], p) ? p : ends[1];
      found = true;
    });
}

template <typename T>
Bytes pack(const T& value)
{
  ByteWriter writer;
  writer.value(value);
  return writer.take();
}

Verdict judge(const std::vector<Bytes>& surveys)
{
  Verdict verdict{ { HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL }, 1 };
  std::vector<Point2> ends;
  for (const Bytes& bytes : surveys)
  {
    const auto survey = ByteReader(bytes).value<RankSurvey>();
    if (survey.Finite == 0)
    {
      continue;
    }
    verdict.Bounds = { std::min(verdict.Bounds.xmin, survey.Bounds.xmin),
      std::min(verdict.Bounds.ymin, survey.Bounds.ymin),
      std::max(verdict.Bounds.xmax, survey.Bounds.xmax),
      std::max(verdict.Bounds.ymax, survey.Bounds.ymax) };
    verdict.IsCollinear = verdict.IsCollinear && survey.IsCollinear;
    ends.insert(ends.end(), { survey.Ends[0], survey.Ends[1] });
  }
  if (ends.empty())
  {
    verdict.Bounds = {};
  }
  else if (verdict.IsCollinear)
  {
    verdict.IsCollinear = areCollinear(PointsView(&ends.front().x, ends.size(), 2));
  }
  return verdict;
}

} // namespace

Survey surveyRanks(Communicator& ranks, PointsView points, int threads)
{
  PointSurvey local = surveyPoints(points, threads);
  Survey survey;
  survey.Points = points;
  survey.Rejected = std::move(local.Rejected);
  RankSurvey own{};
  own.Bounds = local.Bounds;
  own.Finite = std::int64_t(points.size() - survey.Rejected.size());
  own.IsCollinear = areCollinear(points);
  if (own.IsCollinear)
  {
    findEnds(points, own.Ends);
  }
  const std::vector<Bytes> all = ranks.gather(pack(own));
  const Bytes judged = ranks.broadcast(ranks.rank() == 0 ? pack(judge(all)) : Bytes());
  const auto verdict = ByteReader(judged).value<Verdict>();
  survey.Bounds = verdict.Bounds;
  survey.IsCollinear = verdict.IsCollinear != 0;

  // Either all ranks scale, or none.
  const PointsView moderate = withModerateMagnitude(points, survey.Bounds);
  std::vector<std::int64_t> kept = { moderate.factor() == 1 };
  ranks.sum(kept);
  if (kept[0] == 0)
  {
    survey.Points = moderate;
    const double factor = moderate.factor();
    survey.Bounds = { survey.Bounds.xmin * factor, survey.Bounds.ymin * factor,
      survey.Bounds.xmax * factor, survey.Bounds.ymax * factor };
  }
  return survey;
}

std::vector<Point2> gatherSample(
  Communicator& ranks, PointsView points, std::int64_t allPoints, std::size_t wanted)
{
  const double share = double(points.size()) / double(std::max<std::int64_t>(1, allPoints));
  ByteWriter writer;
  writer.array(samplePoints(points, static_cast<std::size_t>(std::ceil(share * double(wanted)))));
  std::vector<Point2> sample;
  for (const Bytes& bytes : ranks.gather(writer.take()))
  {
    const auto part = ByteReader(bytes).array<Point2>();
    sample.insert(sample.end(), part.begin(), part.end());
  }
  return sample;
}

} // namespace tipp
