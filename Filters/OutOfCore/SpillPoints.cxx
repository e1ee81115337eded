// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/SpillPoints.h"

#include "Files/IOError.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// Finds the pieces of a block's points, and the places of initial points within their pieces.
class Labelling
{
public:
  Labelling(PiecePlan& plan, double factor, int threads)
    : Plan(plan)
    , Factor(factor)
    , Threads(threads)
    , Counts(std::size_t(plan.pieces()), 0)
  {
  }

  void label(const PointBlock& block)
  {
    const std::size_t count = block.size();
    this->Labels.resize(count);
    constexpr std::size_t stretch = 4096;
    const auto stretches = std::ptrdiff_t((count + stretch - 1) / stretch);
#pragma omp parallel for num_threads(this->Threads) schedule(static)
    for (std::ptrdiff_t s = 0; s < stretches; ++s)
    {
      const std::size_t begin = std::size_t(s) * stretch;
      this->labelStretch(block, begin, std::min(count, begin + stretch));
    }
    this->countPoints(block.First);
  }

  std::int32_t labelOf(std::size_t i) const
  {
    return this->Labels[i];
  }
  const std::vector<std::int64_t>& counts() const
  {
    return this->Counts;
  }

private:
  void labelStretch(const PointBlock& block, std::size_t begin, std::size_t end)
  {
    constexpr std::size_t group = 64;
    Point2 places[group];
    std::uint32_t pieces[group];
    for (; begin < end; begin += group)
    {
      const std::size_t size = std::min(group, end - begin);
      for (std::size_t i = 0; i < size; ++i)
      {
        places[i] = { block.XY[2 * (begin + i)] * this->Factor,
          block.XY[2 * (begin + i) + 1] * this->Factor };
      }
      this->Plan.Pieces.locate(places, size, pieces);
      for (std::size_t i = 0; i < size; ++i)
      {
        this->Labels[begin + i] = isFinite(places[i]) ? std::int32_t(pieces[i]) : -1;
      }
    }
  }

  void countPoints(std::int64_t first)
  {
    std::vector<InitialPoint>& initial = this->Plan.Initial;
    for (std::size_t i = 0; i < this->Labels.size(); ++i)
    {
      const std::int32_t piece = this->Labels[i];
      if (this->NextInitial < initial.size() &&
        initial[this->NextInitial].Id == first + std::int64_t(i))
      {
        initial[this->NextInitial++].InPieces = this->Counts[std::size_t(piece)];
      }
      if (piece >= 0)
      {
        ++this->Counts[std::size_t(piece)];
      }
    }
  }

  PiecePlan& Plan;
  const double Factor;
  const int Threads;
  std::vector<std::int32_t> Labels;
  std::vector<std::int64_t> Counts;
  std::size_t NextInitial = 0;
};

/// As PointRowLayout has it.
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

SpilledPoints::SpilledPoints(PointStream& points, const InputSurvey& survey, PiecePlan& plan,
  const PointRowLayout& rows, const std::string& file, std::size_t blockPoints, int threads,
  const std::function<void(std::int64_t)>& progress)
  : Rows(file, 0, std::size_t(plan.pieces()), 8 * rows.Words)
{
  this->Rows.protect();
  Labelling labelling(plan, survey.Factor, threads);
  std::int64_t seen = 0;
  forEachBlock(points, blockPoints,
    [&](PointBlock& block)
    {
      labelling.label(block);
      this->Rows.add(
        block.size(), threads, [&](std::size_t i) { return labelling.labelOf(i); },
        [&](std::size_t i, char* to) { writeRow(block, i, to); });
      seen = block.First + std::int64_t(block.size());
      progress(seen);
    });
  this->Rows.exchange(Ranks(nullptr));
  this->Starts = { 0 };
  for (const std::int64_t count : labelling.counts())
  {
    this->Starts.push_back(this->Starts.back() + count);
  }
  if (seen != survey.Points || this->Starts.back() != survey.Points - survey.Rejected)
  {
    throw IOError("The input has changed while it was read; start again.");
  }
  for (InitialPoint& p : plan.Initial)
  {
    p.InPieces += this->Starts[std::size_t(plan.PieceOf[std::size_t(p.Partition)])];
  }
}

} // namespace tipp
