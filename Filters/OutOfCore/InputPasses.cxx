// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/InputPasses.h"

#include "Files/IOError.h"
#include "OutOfCore/ScratchFiles.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tipp
{

void throwChanged()
{
  throw IOError("The input has changed while it was read; start again.");
}

namespace
{

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
    constexpr std::size_t length = 4096;
    const auto ranges = std::ptrdiff_t((count + length - 1) / length);
#pragma omp parallel for num_threads(this->Threads) schedule(static)
    for (std::ptrdiff_t r = 0; r < ranges; ++r)
    {
      const std::size_t begin = std::size_t(r) * length;
      this->labelRange(block, begin, std::min(count, begin + length));
    }
    this->countPoints(block.First);
  }

  std::int32_t labelOf(std::size_t i) const
  {
    return this->Labels[i];
  }
  const std::vector<std::int64_t>& inPieces() const
  {
    return this->InPieces;
  }

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
  std::vector<std::int32_t> Labels;
  std::vector<std::int64_t> Counts;
  std::vector<std::int64_t> InPieces;
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
        block.size(), options.Threads, [&](std::size_t i) { return labelling.labelOf(i); },
        [&](std::size_t i, char* to) { writeRow(block, i, to); });
      spilled.Points += std::int64_t(block.size());
      options.Progress(spilled.Points);
    });
  spilled.Rows = spill.close();
  spilled.InPieces = labelling.inPieces();
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
  std::vector<std::int64_t> starts(before.size() + 1, 0);
  std::partial_sum(before.begin(), before.end(), starts.begin() + 1);
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

SpilledPoints::SpilledPoints(
  const std::string& file, std::size_t words, const std::vector<SpilledRows>& parts)
  : Rows(file, parts.front().Counts.size(), 8 * words, parts)
{
  this->setStarts();
}

SpilledPoints::SpilledPoints(
  const std::string& file, std::size_t words, PartitionIndex pieces, LoadArchive& archive)
  : Rows(file, std::size_t(pieces), 8 * words, archive.get<SpilledRows>())
{
  this->setStarts();
}

void SpilledPoints::setStarts()
{
  const std::vector<std::int64_t>& counts = this->Rows.content().Counts;
  this->Starts.assign(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), this->Starts.begin() + 1);
}

void SpilledPoints::save(SaveArchive& archive) const
{
  archive(this->Rows.content());
}

PartitionIndex SpilledPoints::pieceOf(std::int64_t index) const
{
  return PartitionIndex(
    std::upper_bound(this->Starts.begin(), this->Starts.end(), index) - this->Starts.begin() - 1);
}

template <typename Archive>
void serialize(Archive& archive, SpilledPart& part)
{
  archive(part.Points, part.Rows, part.InPieces);
}

namespace
{

void limitToPart(PointStream& points, std::int64_t total, int part, int parts)
{
  const auto before = [&](int p) { return total / parts * p + total % parts * p / parts; };
  if (total >= 0)
  {
    points.limitTo(before(part), before(part + 1));
  }
}

} // namespace

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

/// Returns one result per part. Each other rank gets `order` and answers; if it has no result, or
/// if there are no ranks, work(part) computes it here with the stream limited to the part.
template <typename Result, typename Work>
std::vector<Result> InputPasses::share(MessageKind kind, SaveArchive order, const Work& work)
{
  const Bytes bytes = order.take();
  for (int to = 1; to < this->Parts; ++to)
  {
    Bytes copy(bytes.size());
    std::copy(bytes.begin(), bytes.end(), copy.begin());
    this->Ranks->post(to, kind, std::move(copy));
  }
  std::vector<Result> results;
  for (int part = 0; part < this->Parts; ++part)
  {
    const Bytes answer = part == 0 ? Bytes() : this->answerOf(part);
    if (answer.size() == 0)
    {
      limitToPart(this->Points, this->Total, part, this->Parts);
      results.push_back(work(part));
      continue;
    }
    results.push_back(unpacked<Result>(answer));
  }
  return results;
}

InputSurvey InputPasses::survey()
{
  SaveArchive order;
  order(this->Points.identity(), this->Total, std::uint64_t(this->Options.BlockPoints),
    std::uint64_t(this->Options.SamplePoints));
  std::vector<InputSurvey> parts = this->share<InputSurvey>(SurveyMessage, std::move(order),
    [this](int) { return surveyPart(this->Points, this->Options); });
  InputSurvey survey = joinSurveys(parts);
  if (mayNeedFactor(survey))
  {
    applyFactor(survey, this->commonFactor(survey));
  }
  return survey;
}

double InputPasses::commonFactor(const InputSurvey& survey)
{
  SaveArchive order;
  order(survey.Bounds);
  const std::vector<double> factors = this->share<double>(FactorMessage, std::move(order),
    [&](int) { return factorOfPart(this->Points, this->Options.BlockPoints, survey.Bounds); });
  return std::count(factors.begin(), factors.end(), 1.0) > 0 ? 1 : factors[0];
}

std::unique_ptr<SpilledPoints> InputPasses::spill(
  const InputSurvey& survey, PiecePlan& plan, const std::string& file)
{
  SaveArchive order;
  order(file, survey.Factor);
  plan.save(order);
  const std::vector<SpilledPart> parts = this->share<SpilledPart>(SpillMessage, std::move(order),
    [&](int part)
    { return spillPart(this->Points, survey.Factor, plan, file, part, this->Options); });
  placeInitialPoints(parts, survey, plan);
  std::vector<SpilledRows> rows(parts.size());
  std::transform(
    parts.begin(), parts.end(), rows.begin(), [](const SpilledPart& part) { return part.Rows; });
  return std::make_unique<SpilledPoints>(file, 3 + this->Points.columns().size(), rows);
}

InputHelper::InputHelper(Communicator& ranks, OpenPoints open, PassOptions options)
  : Ranks(ranks)
  , Open(std::move(open))
  , Options(std::move(options))
{
}

bool InputHelper::take(const Message& message)
{
  if (message.Kind != SurveyMessage && message.Kind != FactorMessage &&
    message.Kind != SpillMessage)
  {
    return false;
  }
  LoadArchive order(message.Content);
  if (message.Kind == SurveyMessage)
  {
    this->open(order);
  }
  Bytes answer; // empty: the first rank must read the part
  if (this->Points)
  {
    PointStream& points = *this->Points;
    answer = message.Kind == SurveyMessage ? packed(surveyPart(points, this->Options))
      : message.Kind == FactorMessage
      ? packed(factorOfPart(points, this->Options.BlockPoints, order.get<Box2>()))
      : this->spill(order);
  }
  this->Ranks.post(0, PartMessage, std::move(answer));
  return true;
}

void InputHelper::open(LoadArchive& order)
{
  std::string identity;
  std::int64_t total = 0;
  std::uint64_t block = 0;
  std::uint64_t sample = 0;
  order(identity, total, block, sample);
  this->Options.BlockPoints = std::size_t(block);
  this->Options.SamplePoints = std::size_t(sample);
  try
  {
    this->Points = this->Open();
    if (this->Points->identity() != identity || this->Points->divisible() != total)
    {
      this->Points.reset();
      return;
    }
    limitToPart(*this->Points, total, this->Ranks.rank(), this->Ranks.size());
  }
  catch (const IOError&)
  {
    this->Points.reset();
  }
}

Bytes InputHelper::spill(LoadArchive& order)
{
  std::string file;
  double factor = 1;
  order(file, factor);
  const PiecePlan plan(order);
  return packed(spillPart(*this->Points, factor, plan, file, this->Ranks.rank(), this->Options));
}

} // namespace tipp
