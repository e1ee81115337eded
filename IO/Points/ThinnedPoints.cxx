// SPDX-License-Identifier: BSD-3-Clause

#include "Arrays/Decimal.h"
#include "Files/IOError.h"
#include "Parallel/Poll.h"
#include "Points/ReadPoints.h"
#include "Ranks/Spill.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

/// A candidate for the point to keep in a square: the one of lowest rank is kept.
struct Candidate
{
  double Column; ///< of the square
  double Row;
  double Rank;
  std::int64_t Id;
};

std::uint64_t hashOf(const Candidate& candidate)
{
  std::uint64_t words[2];
  const double square[2] = { candidate.Column + 0.0, candidate.Row + 0.0 }; // -0 is 0
  std::memcpy(words, square, sizeof words);
  std::uint64_t hash = words[0] * 0x9e3779b97f4a7c15U;
  hash = (hash ^ (hash >> 29) ^ words[1]) * 0xbf58476d1ce4e5b9U;
  return hash ^ (hash >> 32);
}

/// The best candidate of each square.
class SquareTable
{
public:
  SquareTable() { this->Slots.resize(std::size_t(1) << 10, empty); }

  void offer(const Candidate& candidate)
  {
    if (2 * (this->Count + 1) > this->Slots.size())
    {
      this->grow();
    }
    Candidate& slot = this->slotOf(candidate);
    this->Count += slot.Id < 0 ? 1 : 0;
    const bool isBetter =
      candidate.Rank < slot.Rank || (candidate.Rank == slot.Rank && candidate.Id < slot.Id);
    if (slot.Id < 0 || isBetter)
    {
      slot = candidate;
    }
  }

  template <typename Visit>
  void forEach(const Visit& visit) const
  {
    for (const Candidate& slot : this->Slots)
    {
      if (slot.Id >= 0)
      {
        visit(slot.Id);
      }
    }
  }

private:
  static constexpr Candidate empty{ 0, 0, 0, -1 };

  Candidate& slotOf(const Candidate& candidate)
  {
    std::size_t at = hashOf(candidate) & (this->Slots.size() - 1);
    while (this->Slots[at].Id >= 0 &&
      (this->Slots[at].Column != candidate.Column || this->Slots[at].Row != candidate.Row))
    {
      at = (at + 1) & (this->Slots.size() - 1);
    }
    return this->Slots[at];
  }

  void grow()
  {
    std::vector<Candidate> old(2 * this->Slots.size(), empty);
    old.swap(this->Slots);
    for (const Candidate& candidate : old)
    {
      if (candidate.Id >= 0)
      {
        this->slotOf(candidate) = candidate;
      }
    }
  }

  std::vector<Candidate> Slots; ///< a power of two; at least half of them are empty
  std::size_t Count = 0;
};

/// Where a coordinate lies along an axis of the squares.
struct InSquare
{
  double Number;     ///< of the square
  double FromCentre; ///< twice the distance from its centre, in billionths
};

/// Decides with the decimal numbers that users write. Exact if the coordinate and the side have at
/// most nine decimals; otherwise a coordinate within rounding of a border counts as on it.
InSquare squareOf(double coordinate, double side)
{
  constexpr double unit = 1e9;
  constexpr double most = 0x1p53;
  const double at = std::nearbyint(coordinate * unit);
  const double size = std::nearbyint(side * unit);
  if (std::fabs(at) < most && size < most && at / unit == coordinate && size / unit == side)
  {
    const auto whole = std::int64_t(at);
    const auto wholeSize = std::int64_t(size);
    const std::int64_t number = whole / wholeSize - (whole % wholeSize < 0 ? 1 : 0);
    return { double(number), double(2 * (whole - number * wholeSize) - wholeSize) };
  }
  constexpr double unsure = 0x1p-48;
  const double sides = coordinate / side;
  const bool isClear =
    std::fabs(sides - std::nearbyint(sides)) > unsure * std::max(1.0, std::fabs(sides));
  const double number =
    isClear ? std::floor(sides) : stepsUpTo(0, side, coordinate, roundingOf(std::fabs(coordinate)));
  return { number, unit * (2 * (coordinate - number * side) - side) };
}

/// Returns a * a + b * b, rounded once, for whole numbers of at most 54 bits: then equal distances
/// have equal squares.
double squareSum(double a, double b)
{
  constexpr double most = 0x1p54;
  if (!(std::fabs(a) <= most && std::fabs(b) <= most))
  {
    return a * a + b * b;
  }
  __extension__ using Wide = __int128;
  const auto squareOf = [](double value)
  { return Wide(std::int64_t(value)) * std::int64_t(value); };
  const bool isWhole = std::floor(a) == a && std::floor(b) == b;
  return isWhole ? double(squareOf(a) + squareOf(b)) : a * a + b * b;
}

class ThinnedPoints : public PointStream
{
public:
  ThinnedPoints(std::unique_ptr<PointStream> points, const Thinning& thinning)
    : All(std::move(points))
    , Rule(thinning)
    , Elevation(findRankColumn(this->All->columns()))
  {
    if (thinning.Keep != Thinning::Rule::Nearest && this->Elevation == this->All->columns().size())
    {
      throw IOError("The points have no column z, elevation or depth, nor a single other one, by "
                    "which to choose the lowest or highest of a square; thin by 'nearest'.");
    }
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    this->decide();
    while (this->All->next(block, most))
    {
      block.keepIf([&](std::size_t i) { return this->Kept[std::size_t(block.First) + i]; });
      if (block.size() > 0)
      {
        block.First = this->Points;
        this->Points += std::int64_t(block.size());
        return true;
      }
    }
    return false;
  }

  void rewind() override
  {
    this->decide();
    this->All->rewind();
    this->Points = 0;
  }

  /// Not called, because divisible() is -1: the number of points is unknown before the first pass.
  void limitTo(std::int64_t, std::int64_t) override {}

  std::vector<std::string> columns() const override { return this->All->columns(); }
  std::int64_t leftOut() const override { return this->All->leftOut(); }
  std::int64_t thinnedOut() const override { return this->Seen - this->KeptCount; }
  ReferenceSystem referenceSystem() const override { return this->All->referenceSystem(); }
  std::vector<TableReport> reports() const override { return this->All->reports(); }
  ReadFigures readFigures() const override { return this->All->readFigures(); }

  std::string identity() const override
  {
    char text[64];
    std::snprintf(text, sizeof text, "thin %.17g %d\n", this->Rule.Cell, int(this->Rule.Keep));
    return this->All->identity() + text;
  }

private:
  static constexpr std::size_t blockPoints = std::size_t(1) << 16;

  /// Finds the points to keep, in a pass over all of them.
  void decide()
  {
    if (this->IsDecided)
    {
      return;
    }
    this->Rule.File.empty() ? this->decideInMemory() : this->decideOnDisk();
    this->IsDecided = true;
    this->All->rewind();
  }

  void decideInMemory()
  {
    SquareTable squares;
    this->forEachCandidate(
      [&](const std::vector<Candidate>& candidates)
      {
        for (const Candidate& candidate : candidates)
        {
          squares.offer(candidate);
        }
      });
    squares.forEach([this](std::int64_t id) { this->keep(id); });
  }

  /// The same with a temporary file: squares are distributed by their hash, so that only a part of
  /// them is in memory at a time.
  void decideOnDisk()
  {
    constexpr std::size_t keys = 1024;
    KeyedRows rows(this->Rule.File, keys, sizeof(Candidate));
    this->forEachCandidate(
      [&](const std::vector<Candidate>& candidates)
      {
        for (const Candidate& candidate : candidates)
        {
          rows.add(hashOf(candidate) >> 20 & (keys - 1), &candidate);
        }
      });
    rows.finish();
    for (std::size_t key = 0; key < keys; ++key)
    {
      SquareTable squares;
      rows.forEach(key,
        [&squares](const char* bytes)
        {
          Candidate candidate;
          std::memcpy(&candidate, bytes, sizeof candidate);
          squares.offer(candidate);
        });
      squares.forEach([this](std::int64_t id) { this->keep(id); });
    }
  }

  template <typename Take>
  void forEachCandidate(const Take& take)
  {
    std::vector<Candidate> candidates;
    forEachBlock(*this->All, blockPoints,
      [&](const PointBlock& block)
      {
        poll();
        const std::size_t end = std::size_t(block.First) + block.size();
        this->Kept.resize(end);
        candidates.clear();
        for (std::size_t i = 0; i < block.size(); ++i)
        {
          const std::int64_t id = block.First + std::int64_t(i);
          std::isfinite(block.XY[2 * i]) && std::isfinite(block.XY[2 * i + 1])
            ? candidates.push_back(this->candidateOf(block, i, id))
            : this->keep(id);
        }
        take(candidates);
        this->Seen = std::int64_t(end);
      });
  }

  Candidate candidateOf(const PointBlock& block, std::size_t i, std::int64_t id) const
  {
    const InSquare x = squareOf(block.XY[2 * i], this->Rule.Cell);
    const InSquare y = squareOf(block.XY[2 * i + 1], this->Rule.Cell);
    double rank = 0;
    if (this->Rule.Keep == Thinning::Rule::Nearest)
    {
      rank = squareSum(x.FromCentre, y.FromCentre);
    }
    else
    {
      const double z = block.Columns[this->Elevation][i];
      rank = !std::isfinite(z)                      ? std::numeric_limits<double>::infinity()
        : this->Rule.Keep == Thinning::Rule::Lowest ? z
                                                    : -z;
    }
    return { x.Number, y.Number, rank, id };
  }

  void keep(std::int64_t id)
  {
    this->Kept[std::size_t(id)] = true;
    ++this->KeptCount;
  }

  const std::unique_ptr<PointStream> All;
  const Thinning Rule;
  const std::size_t Elevation;
  std::vector<bool> Kept; ///< one bit per point
  bool IsDecided = false;
  std::int64_t Seen = 0;
  std::int64_t KeptCount = 0;
  std::int64_t Points = 0; ///< points of this pass so far
};

} // namespace

std::unique_ptr<PointStream> thinPoints(
  std::unique_ptr<PointStream> points, const Thinning& thinning)
{
  return std::make_unique<ThinnedPoints>(std::move(points), thinning);
}

} // namespace tipp
