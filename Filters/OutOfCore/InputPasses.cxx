// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/InputPasses.h"

#include "Files/IOError.h"
#include "OutOfCore/OutOfCoreMessages.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/StreamSampler.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

namespace tipp
{

namespace
{

/// Gives the points of blocks as views; coordinates are not scaled.
template <int D>
class BlockPoints
{
public:
  explicit BlockPoints(const std::vector<std::string>& columns)
    : Elevation(findElevation(columns))
  {
  }

  /// The view is valid until the next call.
  PointsViewOf<D> of(const PointBlock& block)
  {
    if constexpr (D == 2)
    {
      return { block.XY.data(), block.size(), 2 };
    }
    else
    {
      const std::vector<double>& z = block.Columns[this->Elevation];
      this->Positions.resize(block.size());
      for (std::size_t i = 0; i < z.size(); ++i)
      {
        this->Positions[i] = { block.XY[2 * i], block.XY[2 * i + 1], z[i] };
      }
      return PointsViewOf<D>(this->Positions);
    }
  }

private:
  const std::size_t Elevation;
  std::vector<Point<D>> Positions; ///< in space
};

} // namespace

template <int D>
InputSurveyOf<D> surveyPart(PointStream& points, std::int64_t total, const PassOptions& options)
{
  InputSurveyOf<D> survey;
  StreamSampler<Point<D>> sampler(options.SamplePoints, total);
  DimensionTest<D> dimension;
  const std::size_t elevation = findElevation(points.columns());
  BlockPoints<D> blocks(points.columns());
  points.needColumns(D == 3);
  forEachBlock(points, options.BlockPoints,
    [&](PointBlock& block)
    {
      const PointsViewOf<D> view = blocks.of(block);
      const PointSurveyOf<D> part = surveyPoints(view, options.Threads);
      survey.Bounds.extend(part.Bounds);
      survey.Rejected += std::int64_t(part.Rejected.size());
      survey.WithoutElevation +=
        D == 2 && elevation < block.Columns.size() ? countMissing(block.Columns[elevation]) : 0;
      sampler.add(block.First, view);
      for (std::size_t i = 0; !dimension.isFull() && i < view.size(); ++i)
      {
        dimension.add(view[i]);
      }
      survey.Points += std::int64_t(block.size());
      options.Progress(survey.Points);
    });
  points.needColumns(true);
  survey.Simplex = dimension.simplex();
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
  archive(part.Points, part.Rows, part.InPieces, part.Extremes);
}

namespace
{

/// Returns the InputSurveyOf::Factor that is exact for all points of a part; 1 if there is none.
/// Reads the part. `bounds`: of all points, not scaled. Throws IOError.
template <int D>
double factorOfPart(PointStream& points, std::size_t blockPoints, const Box<D>& bounds)
{
  double factor = withModerateMagnitude(PointsViewOf<D>(), bounds).factor();
  BlockPoints<D> blocks(points.columns());
  forEachBlock(points, blockPoints,
    [&](PointBlock& block)
    { factor = factor == 1 ? 1 : withModerateMagnitude(blocks.of(block), bounds).factor(); });
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

///@{
/// Finds the piece of each point; PartitionFinder::None if it is not finite.
void findPieces(
  const PartitionFinder& finder, const Point2* points, std::size_t count, std::uint32_t* pieces)
{
  finder.locate(points, count, pieces);
}
void findPieces(
  const Tiling3& tiling, const Point3* points, std::size_t count, std::uint32_t* pieces)
{
  std::transform(points, points + count, pieces,
    [&tiling](const Point3& p)
    { return isFinite(p) ? std::uint32_t(tiling.locate(p)) : PartitionFinder::None; });
}
///@}

/// Finds the pieces of a block's points, the indices of initial points within their pieces and, in
/// space, the extreme points of pieces.
template <typename Plan>
class Labelling
{
public:
  static constexpr int D = Plan::Dimensions;

  Labelling(const Plan& plan, double factor, int threads)
    : Divided(plan)
    , Pieces(plan.Pieces)
    , Factor(factor)
    , Threads(threads)
    , Counts(std::size_t(plan.pieces()), 0)
    , Extremes(D == 3 ? std::size_t(plan.pieces()) : 0)
  {
  }

  /// `first`: the id of the first point.
  void label(std::int64_t first, const PointsViewOf<D>& block)
  {
    const PointsViewOf<D> points = block.scaled(this->Factor);
    this->Labels.resize(points.size());
    constexpr std::int64_t length = 4096;
    forChunks(std::int64_t(points.size()), length, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      { this->labelRange(points, std::size_t(begin), std::size_t(end)); });
    this->countPoints(first, points);
  }

  std::vector<std::int32_t> Labels;   ///< by point of the block: its piece; -1: none
  std::vector<std::int64_t> InPieces; ///< see SpilledPart

  std::vector<ExtremePoints> takeExtremes() { return std::move(this->Extremes); }

private:
  void labelRange(const PointsViewOf<D>& points, std::size_t begin, std::size_t end)
  {
    points.forBlocks(begin, end,
      [this](std::size_t first, const Point<D>* block, std::size_t count)
      {
        static_assert(std::int32_t(PartitionFinder::None) == -1, "the label of no piece");
        findPieces(this->Pieces, block, count,
          reinterpret_cast<std::uint32_t*>(this->Labels.data() + first));
      });
  }

  void countPoints(std::int64_t first, const PointsViewOf<D>& points)
  {
    const auto& initial = this->Divided.Initial;
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
        if (piece != this->Divided.pieceOf(initial[this->NextInitial]))
        {
          throwChanged();
        }
        this->InPieces.push_back(this->Counts[std::size_t(piece)]);
        ++this->NextInitial;
      }
      if (piece >= 0)
      {
        if constexpr (D == 3)
        {
          this->Extremes[std::size_t(piece)].add(this->Counts[std::size_t(piece)], points[i]);
        }
        ++this->Counts[std::size_t(piece)];
      }
    }
  }

  const Plan& Divided;
  const std::conditional_t<D == 2, PartitionFinder, const Tiling3&> Pieces;
  const double Factor;
  const int Threads;
  std::vector<std::int64_t> Counts;
  std::vector<ExtremePoints> Extremes;
  std::size_t NextInitial = 0;
};

/// Writes the row of point number i of the block to `to`, in the order of PointRowLayout.
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

} // namespace

template <typename Plan>
SpilledPart spillPart(PointStream& points, double factor, const Plan& plan, const std::string& file,
  int part, const PassOptions& options)
{
  Spill spill(file, part, std::size_t(plan.pieces()), 8 * (3 + points.columns().size()));
  spill.protect();
  Labelling<Plan> labelling(plan, factor, options.Threads);
  BlockPoints<Plan::Dimensions> blocks(points.columns());
  SpilledPart spilled;
  forEachBlock(points, options.BlockPoints,
    [&](PointBlock& block)
    {
      labelling.label(block.First, blocks.of(block));
      spill.add(
        block.size(), options.Threads, [&](std::size_t i) { return labelling.Labels[i]; },
        [&](std::size_t i, char* to) { writeRow(block, i, to); });
      spilled.Points += std::int64_t(block.size());
      options.Progress(spilled.Points);
    });
  spilled.Rows = spill.close();
  spilled.InPieces = std::move(labelling.InPieces);
  spilled.Extremes = labelling.takeExtremes();
  return spilled;
}

template <typename Plan>
void placeInitialPoints(
  const std::vector<SpilledPart>& parts, const InputSurveyOf<Plan::Dimensions>& survey, Plan& plan)
{
  std::int64_t seen = 0;
  if constexpr (Plan::Dimensions == 3)
  {
    plan.Extremes.assign(std::size_t(plan.pieces()), {});
  }
  // By piece: the points in earlier parts.
  std::vector<std::int64_t> before(std::size_t(plan.pieces()), 0);
  auto next = plan.Initial.begin();
  for (const SpilledPart& part : parts)
  {
    seen += part.Points;
    for (std::size_t i = 0; i < part.InPieces.size() && next != plan.Initial.end(); ++i)
    {
      const PartitionIndex piece = plan.pieceOf(*next);
      next->InPieces = before.at(std::size_t(piece)) + part.InPieces[i];
      ++next;
    }
    for (std::size_t piece = 0; piece < before.size(); ++piece)
    {
      if constexpr (Plan::Dimensions == 3)
      {
        plan.Extremes[piece].add(part.Extremes.at(piece), before[piece]);
      }
      before[piece] += part.Rows.Counts.at(piece);
    }
  }
  const std::vector<std::int64_t> starts = startsOf(before);
  if (seen != survey.Points || starts.back() != survey.finite() || next != plan.Initial.end())
  {
    throwChanged();
  }
  for (auto& p : plan.Initial)
  {
    p.InPieces += starts[std::size_t(plan.pieceOf(p))];
  }
  if constexpr (Plan::Dimensions == 3)
  {
    plan.encloseExtremes(starts);
  }
}

template <typename Plan>
InputPassesOf<Plan>::InputPassesOf(
  PointStream& points, Communicator* ranks, const PassOptions& options)
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
template <typename Plan>
void InputPassesOf<Plan>::poll()
{
  Message message;
  while (this->Ranks && this->Ranks->poll(message))
  {
    this->Arrived.push_back(std::move(message));
  }
}

template <typename Plan>
Bytes InputPassesOf<Plan>::answerOf(int rank)
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
template <typename Plan>
template <typename Result, typename SaveOrder, typename Work>
std::vector<Result> InputPassesOf<Plan>::share(
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

template <typename Plan>
typename InputPassesOf<Plan>::Survey InputPassesOf<Plan>::survey()
{
  constexpr int D = Plan::Dimensions;
  std::vector<Survey> parts = this->share<Survey>(
    SurveyMessage,
    [this](SaveArchive& order)
    {
      order(this->Points.identity(), this->Total, std::uint64_t(this->Options.BlockPoints),
        std::uint64_t(this->Options.SamplePoints));
    },
    [this](int)
    { return surveyPart<D>(this->Points, this->Parts > 1 ? this->Total : -1, this->Options); });
  Survey survey = joinSurveys(parts);
  survey.LeftOut = this->Points.leftOut();
  survey.ThinnedOut = this->Points.thinnedOut();
  if (withModerateMagnitude(PointsViewOf<D>(), survey.Bounds).factor() != 1)
  {
    const std::vector<double> factors = this->share<double>(
      FactorMessage, [&](SaveArchive& order) { order(survey.Bounds); },
      [&](int) { return factorOfPart<D>(this->Points, this->Options.BlockPoints, survey.Bounds); });
    applyFactor(survey, std::count(factors.begin(), factors.end(), 1.0) > 0 ? 1 : factors[0]);
  }
  return survey;
}

template <typename Plan>
std::unique_ptr<SpilledPoints> InputPassesOf<Plan>::spill(
  const Survey& survey, Plan& plan, const std::string& file)
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

template <typename Plan>
Message helpWithInput(Communicator& ranks, const OpenPoints& open, PassOptions options,
  const std::function<Message()>& next)
{
  constexpr int D = Plan::Dimensions;
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
      answer = packed(surveyPart<D>(*points, points->divisible(), options));
    }
    else if (points && message.Kind == FactorMessage)
    {
      answer = packed(factorOfPart<D>(*points, options.BlockPoints, order.get<Box<D>>()));
    }
    else if (points)
    {
      std::string file;
      double factor = 1;
      order(file, factor);
      answer = packed(spillPart(*points, factor, Plan(order), file, ranks.rank(), options));
    }
    ranks.post(0, PartMessage, std::move(answer));
  }
  return message;
}

template InputSurveyOf<2> surveyPart(
  PointStream& points, std::int64_t total, const PassOptions& options);
template SpilledPart spillPart(PointStream& points, double factor, const PiecePlan& plan,
  const std::string& file, int part, const PassOptions& options);
template void placeInitialPoints(
  const std::vector<SpilledPart>& parts, const InputSurveyOf<2>& survey, PiecePlan& plan);
template class InputPassesOf<PiecePlan>;
template Message helpWithInput<PiecePlan>(Communicator& ranks, const OpenPoints& open,
  PassOptions options, const std::function<Message()>& next);
template InputSurveyOf<3> surveyPart(
  PointStream& points, std::int64_t total, const PassOptions& options);
template SpilledPart spillPart(PointStream& points, double factor, const PiecePlan3& plan,
  const std::string& file, int part, const PassOptions& options);
template void placeInitialPoints(
  const std::vector<SpilledPart>& parts, const InputSurveyOf<3>& survey, PiecePlan3& plan);
template class InputPassesOf<PiecePlan3>;
template Message helpWithInput<PiecePlan3>(Communicator& ranks, const OpenPoints& open,
  PassOptions options, const std::function<Message()>& next);

} // namespace tipp
