// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/InputPasses.h"

#include "Files/IOError.h"
#include "OutOfCore/ScratchFiles.h"
#include "Parallel/Stopwatch.h"

#include <algorithm>
#include <utility>

namespace tipp
{
template <typename Archive>
void serialize(Archive& archive, PartialSurvey& part)
{
  archive(part.Points, part.Rejected, part.Bounds, part.Collinear, part.Line, part.Sample);
}

template <typename Archive>
void serialize(Archive& archive, SpilledPart& part)
{
  archive(part.Points, part.Rows, part.Counts, part.InPieces);
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

InputPasses::InputPasses(PointStream& points, Communicator* ranks, PassOptions options)
  : Points(points)
  , Ranks(ranks)
  , Options(std::move(options))
  , Total(ranks ? points.divisible() : -1)
  , Parts(ranks && this->Total >= 0 ? ranks->size() : 1)
{
}

/// Other ranks answer while this one works.
void InputPasses::poll()
{
  Message message;
  while (this->Ranks && this->Ranks->poll(message))
  {
    this->Arrived.push_back(std::move(message));
  }
}

std::function<void(std::int64_t)> InputPasses::progress()
{
  return [this](std::int64_t done)
  {
    this->poll();
    this->Options.Progress(done);
  };
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

/// One result a part, of work(), which reads what the stream is limited to and is told the part.
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
  std::vector<PartialSurvey> parts = this->share<PartialSurvey>(SurveyMessage, std::move(order),
    [this](int)
    {
      return surveyPart(this->Points, this->Options.BlockPoints, this->Options.SamplePoints,
        this->Options.Threads, this->progress());
    });
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
  const InputSurvey& survey, PiecePlan& plan, const PointRowLayout& rows, const std::string& file)
{
  SaveArchive order;
  order(file, survey.Factor, rows.Words);
  plan.save(order);
  const std::vector<SpilledPart> parts = this->share<SpilledPart>(SpillMessage, std::move(order),
    [&](int part)
    {
      return spillPart(this->Points, survey.Factor, plan, rows, file, part,
        this->Options.BlockPoints, this->Options.Threads, this->progress());
    });
  return std::make_unique<SpilledPoints>(parts, survey, plan, rows, file);
}

InputHelper::InputHelper(
  Communicator& ranks, std::function<std::unique_ptr<PointStream>()> open, PassOptions options)
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
  SaveArchive answer; // empty: the first rank is to do it
  if (this->Points)
  {
    answer = message.Kind == SurveyMessage ? this->survey()
      : message.Kind == FactorMessage      ? this->factor(order)
                                           : this->spill(order);
  }
  this->Ranks.post(0, PartMessage, answer.take());
  return true;
}

void InputHelper::open(LoadArchive& order)
{
  std::string identity;
  std::int64_t total = 0;
  std::uint64_t block = 0;
  std::uint64_t sample = 0;
  order(identity);
  order(total);
  order(block);
  order(sample);
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

SaveArchive InputHelper::survey()
{
  PartialSurvey part = surveyPart(*this->Points, this->Options.BlockPoints,
    this->Options.SamplePoints, this->Options.Threads, this->Options.Progress);
  SaveArchive answer;
  answer(part);
  return answer;
}

SaveArchive InputHelper::factor(LoadArchive& order)
{
  Box2 bounds{};
  order(bounds);
  double factor = factorOfPart(*this->Points, this->Options.BlockPoints, bounds);
  SaveArchive answer;
  answer(factor);
  return answer;
}

SaveArchive InputHelper::spill(LoadArchive& order)
{
  std::string file;
  double factor = 1;
  PointRowLayout rows;
  order(file, factor, rows.Words);
  const PiecePlan plan(order);
  SpilledPart part = spillPart(*this->Points, factor, plan, rows, file, this->Ranks.rank(),
    this->Options.BlockPoints, this->Options.Threads, this->Options.Progress);
  SaveArchive answer;
  answer(part);
  return answer;
}

} // namespace tipp
