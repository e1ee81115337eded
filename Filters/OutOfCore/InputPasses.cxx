// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/InputPasses.h"

#include "Files/IOError.h"
#include "OutOfCore/OutOfCoreMessages.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SpilledPoints.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Triangulation/InputSurvey.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/StreamSampler.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tipp
{

InputSurvey surveyPart(PointStream& points, std::int64_t total, const PassOptions& options)
{
  InputSurvey survey;
  StreamSampler<Point2> sampler(options.SamplePoints, total);
  CollinearityTest line;
  const std::size_t elevation = findElevation(points.columns());
  points.needColumns(false);
  forEachBlock(points, options.BlockPoints,
    [&](PointBlock& block)
    {
      const PointsView view(block.XY.data(), block.size(), 2);
      const PointSurvey part = surveyPoints(view, options.Threads);
      survey.Bounds.extend(part.Bounds);
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
  points.needColumns(true);
  survey.Line = line.line();
  survey.Sample = sampler.take();
  return survey;
}

void throwChanged()
{
  throw IOError("The input has changed while it was read; start again.");
}

template <typename Archive>
void serialize(Archive& archive, SpilledPart& part)
{
  archive(part.Points, part.Rows, part.InPieces);
}

namespace
{

/// Returns the InputSurvey::Factor that is exact for all points of a part; 1 if there is none.
/// Reads the part. `bounds`: of all points, not scaled. Throws IOError.
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

void limitToPart(PointStream& points, std::int64_t total, int part, int parts)
{
  const auto before = [&](int p) { return total / parts * p + total % parts * p / parts; };
  if (total >= 0)
  {
    points.limitTo(before(part), before(part + 1));
  }
}

/// Opens the input as the first rank has ordered, limited to this rank's part, and sets the options
/// that the order contains. Returns null if the input cannot be read or differs.
std::unique_ptr<PointStream> openPart(
  const Communicator& ranks, const OpenPoints& open, LoadArchive& order, PassOptions& options)
{
  std::string identity;
  std::int64_t total = 0;
  std::uint64_t block = 0;
  std::uint64_t sample = 0;
  order(identity, total, block, sample);
  options.BlockPoints = std::size_t(block);
  options.SamplePoints = std::size_t(sample);
  try
  {
    std::unique_ptr<PointStream> points = open();
    if (points->identity() == identity && points->divisible() == total)
    {
      limitToPart(*points, total, ranks.rank(), ranks.size());
      return points;
    }
  }
  catch (const IOError&)
  {
    // The first rank reads the part.
  }
  return nullptr;
}

/// Finds the pieces of a block's points, and the indices of initial points within their pieces.
class Labelling
{
public:
  Labelling(const PiecePlan& plan, double factor, int threads)
    : Plan(plan)
    , Pieces(plan.Pieces)
    , Factor(factor)
    , Threads(threads)
    , Counts(std::size_t(plan.pieces()), 0)
  {
  }

  void label(const PointBlock& block)
  {
    const std::size_t count = block.size();
    this->Labels.resize(count);
    constexpr std::int64_t length = 4096;
    forChunks(std::int64_t(count), length, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      { this->labelRange(block, std::size_t(begin), std::size_t(end)); });
    this->countPoints(block.First);
  }

  std::vector<std::int32_t> Labels;   ///< by point of the block: its piece; -1: none
  std::vector<std::int64_t> InPieces; ///< see SpilledPart

private:
  void labelRange(const PointBlock& block, std::size_t begin, std::size_t end)
  {
    constexpr std::size_t group = 64;
    Point2 scaled[group];
    std::uint32_t pieces[group];
    for (; begin < end; begin += group)
    {
      const std::size_t size = std::min(group, end - begin);
      for (std::size_t i = 0; i < size; ++i)
      {
        scaled[i] = { block.XY[2 * (begin + i)] * this->Factor,
          block.XY[2 * (begin + i) + 1] * this->Factor };
      }
      this->Pieces.locate(scaled, size, pieces);
      static_assert(std::int32_t(PartitionFinder::None) == -1, "the label of no piece");
      std::copy_n(pieces, size, this->Labels.begin() + std::ptrdiff_t(begin));
    }
  }

  void countPoints(std::int64_t first)
  {
    const std::vector<InitialPoint>& initial = this->Plan.Initial;
    while (this->NextInitial < initial.size() && initial[this->NextInitial].Id < first)
    {
      ++this->NextInitial; // initial points of an earlier part
    }
    for (std::size_t i = 0; i < this->Labels.size(); ++i)
    {
      const std::int32_t piece = this->Labels[i];
      if (this->NextInitial < initial.size() &&
        initial[this->NextInitial].Id == first + std::int64_t(i))
      {
        if (piece != this->Plan.PieceOf[std::size_t(initial[this->NextInitial].Partition)])
        {
          throwChanged();
        }
        this->InPieces.push_back(this->Counts[std::size_t(piece)]);
        ++this->NextInitial;
      }
      if (piece >= 0)
      {
        ++this->Counts[std::size_t(piece)];
      }
    }
  }

  const PiecePlan& Plan;
  const PartitionFinder Pieces;
  const double Factor;
  const int Threads;
  std::vector<std::int64_t> Counts;
  std::size_t NextInitial = 0;
};

} // namespace

void writeRow(const PointBlock& block, std::size_t i, char* to)
{
  std::memcpy(to, &block.XY[2 * i], 16);
  to += 16;
  for (const std::vector<double>& column : block.Columns)
  {
    std::memcpy(to, &column[i], 8);
    to += 8;
  }
  const std::int64_t id = block.First + std::int64_t(i);
  std::memcpy(to, &id, 8);
}

SpilledPart spillPart(PointStream& points, double factor, const PiecePlan& plan,
  const std::string& file, int part, const PassOptions& options)
{
  Spill spill(file, part, std::size_t(plan.pieces()), 8 * (3 + points.columns().size()));
  spill.protect();
  Labelling labelling(plan, factor, options.Threads);
  SpilledPart spilled;
  forEachBlock(points, options.BlockPoints,
    [&](PointBlock& block)
    {
      labelling.label(block);
      spill.add(
        block.size(), options.Threads, [&](std::size_t i) { return labelling.Labels[i]; },
        [&](std::size_t i, char* to) { writeRow(block, i, to); });
      spilled.Points += std::int64_t(block.size());
      options.Progress(spilled.Points);
    });
  spilled.Rows = spill.close();
  spilled.InPieces = std::move(labelling.InPieces);
  return spilled;
}

void placeInitialPoints(
  const std::vector<SpilledPart>& parts, const InputSurvey& survey, PiecePlan& plan)
{
  std::int64_t seen = 0;
  // By piece: the points in earlier parts.
  std::vector<std::int64_t> before(std::size_t(plan.pieces()), 0);
  auto next = plan.Initial.begin();
  for (const SpilledPart& part : parts)
  {
    seen += part.Points;
    for (std::size_t i = 0; i < part.InPieces.size() && next != plan.Initial.end(); ++i)
    {
      const std::int32_t piece = plan.PieceOf[std::size_t(next->Partition)];
      next->InPieces = before.at(std::size_t(piece)) + part.InPieces[i];
      ++next;
    }
    for (std::size_t piece = 0; piece < before.size(); ++piece)
    {
      before[piece] += part.Rows.Counts.at(piece);
    }
  }
  const std::vector<std::int64_t> starts = startsOf(before);
  if (seen != survey.Points || starts.back() != survey.Points - survey.Rejected ||
    next != plan.Initial.end())
  {
    throwChanged();
  }
  for (InitialPoint& p : plan.Initial)
  {
    p.InPieces += starts[std::size_t(plan.PieceOf[std::size_t(p.Partition)])];
  }
}

InputPasses::InputPasses(PointStream& points, Communicator* ranks, const PassOptions& options)
  : Points(points)
  , Ranks(ranks)
  , Options{ options.BlockPoints, options.SamplePoints, options.Threads,
    [this, progress = options.Progress](std::int64_t done)
    {
      this->poll();
      progress(done);
    } }
  , Total(ranks ? points.divisible() : -1)
  , Parts(ranks && this->Total >= 0 ? ranks->size() : 1)
{
}

/// Stores the messages of other ranks, which answer while this one works.
void InputPasses::poll()
{
  Message message;
  while (this->Ranks && this->Ranks->poll(message))
  {
    this->Arrived.push_back(std::move(message));
  }
}

Bytes InputPasses::answerOf(int rank)
{
  constexpr double moment = 0.1;
  Stopwatch sinceProgress;
  for (;;)
  {
    const auto found = std::find_if(this->Arrived.begin(), this->Arrived.end(),
      [rank](const Message& message) { return message.Source == rank; });
    if (found != this->Arrived.end())
    {
      Bytes content = std::move(found->Content);
      this->Arrived.erase(found);
      return content;
    }
    if (sinceProgress.seconds() > moment)
    {
      sinceProgress.restart();
      this->Options.Progress(this->Total / this->Parts);
    }
    this->Ranks->pause();
    this->poll();
  }
}

/// Returns one result per part. Each other rank gets a message, whose content saveOrder() saves,
/// and answers. If it has no result, or if there are no ranks, work(part) computes it here with the
/// stream limited to the part.
template <typename Result, typename SaveOrder, typename Work>
std::vector<Result> InputPasses::share(
  MessageKind kind, const SaveOrder& saveOrder, const Work& work)
{
  for (int to = 1; to < this->Parts; ++to)
  {
    SaveArchive order;
    saveOrder(order);
    this->Ranks->post(to, kind, order.take());
  }
  std::vector<Result> results;
  for (int part = 0; part < this->Parts; ++part)
  {
    const Bytes answer = part == 0 ? Bytes() : this->answerOf(part);
    if (answer.size() > 0)
    {
      results.push_back(unpacked<Result>(answer));
      continue;
    }
    limitToPart(this->Points, this->Total, part, this->Parts);
    results.push_back(work(part));
  }
  return results;
}

InputSurvey InputPasses::survey()
{
  std::vector<InputSurvey> parts = this->share<InputSurvey>(
    SurveyMessage,
    [this](SaveArchive& order)
    {
      order(this->Points.identity(), this->Total, std::uint64_t(this->Options.BlockPoints),
        std::uint64_t(this->Options.SamplePoints));
    },
    [this](int)
    { return surveyPart(this->Points, this->Parts > 1 ? this->Total : -1, this->Options); });
  InputSurvey survey = joinSurveys(parts);
  if (survey.Points > survey.Rejected &&
    withModerateMagnitude(PointsView(), survey.Bounds).factor() != 1)
  {
    const std::vector<double> factors = this->share<double>(
      FactorMessage, [&](SaveArchive& order) { order(survey.Bounds); },
      [&](int) { return factorOfPart(this->Points, this->Options.BlockPoints, survey.Bounds); });
    applyFactor(survey, std::count(factors.begin(), factors.end(), 1.0) > 0 ? 1 : factors[0]);
  }
  return survey;
}

std::unique_ptr<SpilledPoints> InputPasses::spill(
  const InputSurvey& survey, PiecePlan& plan, const std::string& file)
{
  const std::vector<SpilledPart> parts = this->share<SpilledPart>(
    SpillMessage,
    [&](SaveArchive& order)
    {
      order(file, survey.Factor);
      plan.save(order);
    },
    [&](int part)
    { return spillPart(this->Points, survey.Factor, plan, file, part, this->Options); });
  placeInitialPoints(parts, survey, plan);
  std::vector<SpilledRows> rows(parts.size());
  std::transform(
    parts.begin(), parts.end(), rows.begin(), [](const SpilledPart& part) { return part.Rows; });
  return std::make_unique<SpilledPoints>(file, 3 + this->Points.columns().size(), rows);
}

Message helpWithInput(Communicator& ranks, const OpenPoints& open, PassOptions options,
  const std::function<Message()>& next)
{
  std::unique_ptr<PointStream> points;
  Message message = next();
  for (; message.Kind == SurveyMessage || message.Kind == FactorMessage ||
       message.Kind == SpillMessage;
       message = next())
  {
    LoadArchive order(message.Content);
    if (message.Kind == SurveyMessage)
    {
      points = openPart(ranks, open, order, options);
    }
    Bytes answer; // empty: the first rank must read the part
    if (points && message.Kind == SurveyMessage)
    {
      answer = packed(surveyPart(*points, points->divisible(), options));
    }
    else if (points && message.Kind == FactorMessage)
    {
      answer = packed(factorOfPart(*points, options.BlockPoints, order.get<Box2>()));
    }
    else if (points)
    {
      std::string file;
      double factor = 1;
      order(file, factor);
      answer = packed(spillPart(*points, factor, PiecePlan(order), file, ranks.rank(), options));
    }
    ranks.post(0, PartMessage, std::move(answer));
  }
  return message;
}

} // namespace tipp
