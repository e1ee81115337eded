// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/SpillPoints.h"

#include "Files/IOError.h"
#include "OutOfCore/ScratchFiles.h"
#include "Triangulation/PartitionFinder.h"

#include <algorithm>
#include <numeric>

namespace tipp
{
namespace
{

[[noreturn]] void throwChanged()
{
  throw IOError("The input has changed while it was read; start again.");
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
  const std::vector<std::int64_t>& counts() const
  {
    return this->Counts;
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
      ++this->NextInitial; // of another part
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

/// In the order of PointRowLayout.
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

std::vector<std::vector<std::uint64_t>> rowsOf(const std::vector<SpilledPart>& parts)
{
  std::vector<std::vector<std::uint64_t>> rows;
  rows.reserve(parts.size());
  for (const SpilledPart& part : parts)
  {
    rows.push_back(part.Rows);
  }
  return rows;
}

} // namespace

SpilledPart spillPart(PointStream& points, double factor, const PiecePlan& plan,
  const PointRowLayout& rows, const std::string& file, int part, std::size_t blockPoints,
  int threads, const std::function<void(std::int64_t)>& progress)
{
  Spill spill(file, part, std::size_t(plan.pieces()), 8 * rows.Words);
  spill.protect();
  Labelling labelling(plan, factor, threads);
  SpilledPart spilled;
  forEachBlock(points, blockPoints,
    [&](PointBlock& block)
    {
      labelling.label(block);
      spill.add(
        block.size(), threads, [&](std::size_t i) { return labelling.labelOf(i); },
        [&](std::size_t i, char* to) { writeRow(block, i, to); });
      spilled.Points += std::int64_t(block.size());
      progress(spilled.Points);
    });
  spilled.Rows = spill.close();
  spilled.Counts = labelling.counts();
  spilled.InPieces = labelling.inPieces();
  return spilled;
}

SpilledPoints::SpilledPoints(const std::vector<SpilledPart>& parts, const InputSurvey& survey,
  PiecePlan& plan, const PointRowLayout& rows, const std::string& file)
  : Starts(std::size_t(plan.pieces()) + 1, 0)
  , Rows(file, std::size_t(plan.pieces()), 8 * rows.Words, rowsOf(parts))
{
  std::int64_t seen = 0;
  std::vector<std::int64_t> before(std::size_t(plan.pieces()), 0); // the part
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
      before[piece] += part.Counts.at(piece);
    }
  }
  std::partial_sum(before.begin(), before.end(), this->Starts.begin() + 1);
  if (seen != survey.Points || this->Starts.back() != survey.Points - survey.Rejected ||
    next != plan.Initial.end())
  {
    throwChanged();
  }
  for (InitialPoint& p : plan.Initial)
  {
    p.InPieces += this->Starts[std::size_t(plan.PieceOf[std::size_t(p.Partition)])];
  }
}

void SpilledPoints::save(SaveArchive& archive) const
{
  archive(this->Starts);
  archive(this->Rows.save());
}

SpilledPoints::SpilledPoints(
  const std::string& file, const PiecePlan& plan, const PointRowLayout& rows, LoadArchive& archive)
  : Starts(
      [&]
      {
        std::vector<std::int64_t> starts;
        archive(starts);
        return starts;
      }())
  , Rows(file, std::size_t(plan.pieces()), 8 * rows.Words,
      [&]
      {
        std::vector<std::uint64_t> saved;
        archive(saved);
        return saved;
      }())
{
  bool isOurs = this->Starts.size() == std::size_t(plan.pieces()) + 1 && this->Starts[0] == 0;
  for (PartitionIndex piece = 0; isOurs && piece < plan.pieces(); ++piece)
  {
    isOurs = this->count(piece) == this->Rows.rows(std::size_t(piece));
  }
  if (!isOurs)
  {
    throw IOError(file, "has points of other pieces; start again.");
  }
}

} // namespace tipp
