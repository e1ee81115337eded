// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/SplitStored.h"

#include "OutOfCore/InputPasses.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{

SegmentTiles::SegmentTiles(
  const std::string& file, const std::function<void(const Visit&)>& forEach, int tiles, int threads)
  : Threads(threads)
{
  Box2 domain{ HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  StreamSampler<Point2> sampler(SamplesPerPartition * std::size_t(tiles), -1);
  std::int64_t count = 0;
  std::vector<Point2> middle(1);
  forEach(
    [&](const SegmentTree::Item& item)
    {
      domain = unionOf(domain, boxOf(item.A, item.B));
      middle[0] = { item.A.x / 2 + item.B.x / 2, item.A.y / 2 + item.B.y / 2 };
      sampler.add(count++, middle);
    });
  std::vector<Point2> sample;
  for (const auto& [number, position] : sampler.take())
  {
    sample.push_back(position);
  }
  constexpr double relative = 0x1p-44; // relative to the largest coordinate
  this->Margin = count == 0 ? 0
                            : relative *
      std::max({ std::fabs(domain.xmin), std::fabs(domain.ymin), std::fabs(domain.xmax),
        std::fabs(domain.ymax) });
  const Tiling tiling = count == 0 ? Tiling::grid({ 0, 0, 0, 0 }, 1, 1)
                                   : Tiling::balanced(domain, std::move(sample), tiles);
  this->Rows = std::make_unique<KeyedRows>(
    file + ".tiles", std::size_t(tiling.size()), sizeof(SegmentTree::Item));
  forEach(
    [&](const SegmentTree::Item& item)
    {
      tiling.visitNear(expanded(boxOf(item.A, item.B), this->Margin),
        [&](PartitionIndex tile)
        {
          lineMayMeet(item.A, item.B, expanded(tiling.box(tile), this->Margin))
            ? this->Rows->add(std::size_t(tile), &item)
            : void();
        });
    });
  this->Rows->finish();
}

void SegmentTiles::findCrossings(const std::function<void(std::int64_t, std::int64_t)>& found) const
{
  for (std::size_t tile = 0; tile < this->Rows->keys(); ++tile)
  {
    for (const CrossingPair& pair :
      findCrossingPairs(this->Rows->readAll<SegmentTree::Item>(tile), this->Threads))
    {
      found(pair[0], pair[1]);
    }
  }
}

void SegmentTiles::findNear(const std::function<bool(std::int64_t)>& isWanted,
  const std::function<void(std::int64_t)>& near) const
{
  for (std::size_t tile = 0; tile < this->Rows->keys(); ++tile)
  {
    std::vector<SegmentTree::Item> items = this->Rows->readAll<SegmentTree::Item>(tile);
    std::vector<SegmentTree::Item> wanted;
    std::copy_if(items.begin(), items.end(), std::back_inserter(wanted),
      [&](const SegmentTree::Item& item) { return isWanted(item.Id); });
    const SegmentTree tree(
      wanted.empty() ? std::vector<SegmentTree::Item>() : std::move(items), this->Threads);
    for (const SegmentTree::Item& item : wanted)
    {
      tree.visitNear(
        item,
        [&](const SegmentTree::Item& other)
        {
          lineMayMeet(item.A, item.B, expanded(boxOf(other.A, other.B), this->Margin))
            ? near(other.Id)
            : void();
          return true;
        },
        this->Margin);
    }
  }
}

namespace
{

using Marks = std::vector<bool>; ///< by index of the constraint

/// How many tiles are needed so that one tile takes a small part of the memory.
int tilesFor(std::int64_t segments, std::uint64_t memory)
{
  constexpr std::uint64_t each = 128; // bytes of a segment and its tree
  constexpr std::uint64_t most = 4096;
  const std::uint64_t share = std::max<std::uint64_t>(1, memory / 16);
  return int(std::clamp<std::uint64_t>(std::uint64_t(segments) * each / share, 1, most));
}

/// Visits the constraints whose ends are finite and different.
template <typename Visit>
void forEachWhole(const StoredConstraints& constraints, const Visit& visit)
{
  constraints.forEach(
    [&visit](std::int64_t number, Point2 a, Point2 b)
    {
      if (isFinite(a) && isFinite(b) && !(a == b))
      {
        visit(SegmentTree::Item{ a, b, number });
      }
    });
}

class Splitter
{
public:
  Splitter(const StoredConstraints& constraints, std::size_t columns, const DiskWork& work)
    : Constraints(constraints)
    , Columns(columns)
    , Work(work)
    , Tiles(
        work.Files, [&](const SegmentTiles::Visit& visit) { forEachWhole(constraints, visit); },
        tilesFor(constraints.count(), work.Memory), work.Threads)
  {
  }

  SplitConstraints split(CrossingRule rule)
  {
    Marks crossing(std::size_t(this->Constraints.count()), false);
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    CrossingPair first{ most, most };
    this->Tiles.findCrossings(
      [&](std::int64_t one, std::int64_t other)
      {
        crossing[std::size_t(one)] = crossing[std::size_t(other)] = true;
        first = std::min(first, { one, other });
      });
    if (first[0] == most)
    {
      return {};
    }
    if (rule == CrossingRule::Refuse)
    {
      this->refuse(first);
    }
    return this->splitNear(std::move(crossing));
  }

private:
  Marks near(const Marks& wanted) const
  {
    Marks all(wanted.size(), false);
    this->Tiles.findNear([&](std::int64_t number) { return wanted[std::size_t(number)]; },
      [&](std::int64_t number) { all[std::size_t(number)] = true; });
    return all;
  }

  Marks allWhole() const
  {
    Marks all(std::size_t(this->Constraints.count()), false);
    forEachWhole(this->Constraints,
      [&all](const SegmentTree::Item& item) { all[std::size_t(item.Id)] = true; });
    return all;
  }

  ResolvedConstraints resolve(
    const StoredConstraints::Ends& ends, CrossingRule rule, const ConstraintNames& names = {}) const
  {
    return resolveCrossings(
      PointsView(ends.Positions), ends.Edges, rule, this->Work.Threads, names);
  }

  [[noreturn]] void refuse(const CrossingPair& pair) const
  {
    const StoredConstraints::Ends ends = this->Constraints.endsOf(
      [&](std::int64_t number) { return number == pair[0] || number == pair[1]; });
    ConstraintNames names;
    names.Constraints = { pair[0], pair[1] };
    names.Points.resize(ends.Positions.size());
    this->Constraints.lookUp(
      ends, [&](std::size_t end, PointId id, const double*) { names.Points[end] = id; });
    this->resolve(ends, CrossingRule::Refuse, names);
    throw std::logic_error("Constraints cross, and do not when they are looked at again.");
  }

  /// `crossing` marks all constraints that cross others. In a round, parts of these move by at most
  /// a unit. So constraints that they newly cross are near them, and these may be led through
  /// points near themselves. Once such a constraint is split, it counts as crossing. No other
  /// constraint can change.
  SplitConstraints splitNear(Marks crossing) const
  {
    bool isAll = false;
    for (;;)
    {
      const Marks taken = isAll ? this->allWhole() : this->near(this->near(crossing));
      std::vector<std::int64_t> numbers;
      for (std::size_t i = 0; i < taken.size(); ++i)
      {
        taken[i] ? numbers.push_back(std::int64_t(i)) : void();
      }
      const StoredConstraints::Ends ends =
        this->Constraints.endsOf([&](std::int64_t number) { return taken[std::size_t(number)]; });
      const ResolvedConstraints resolved = this->resolve(ends, CrossingRule::Split);
      if (!isAll && resolved.Rounds > RoundsOfDoubles) // now they may move far
      {
        isAll = true;
        continue;
      }
      bool isComplete = true;
      SplitConstraints result;
      this->takeParts(ends, resolved, numbers, result);
      for (const SplitConstraints::Part& part : result.Parts)
      {
        isComplete = isComplete && crossing[std::size_t(part.Number)];
        crossing[std::size_t(part.Number)] = true;
      }
      if (isAll || isComplete)
      {
        this->interpolate(ends, resolved, result);
        return result;
      }
    }
  }

  /// Collects the parts of constraints that are split.
  void takeParts(const StoredConstraints::Ends& ends, const ResolvedConstraints& resolved,
    const std::vector<std::int64_t>& numbers, SplitConstraints& result) const
  {
    const auto at = [&](PointId id)
    {
      const auto i = std::size_t(id);
      return i < ends.Positions.size() ? ends.Positions[i]
                                       : resolved.Crossings[i - ends.Positions.size()].Position;
    };
    const std::vector<ConstraintPiece>& pieces = resolved.Pieces;
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      const auto isSame = [&](std::size_t other)
      { return other < pieces.size() && pieces[other].Constraint == pieces[i].Constraint; };
      if (isSame(i + 1) || (i > 0 && isSame(i - 1)))
      {
        result.Parts.push_back(
          { numbers[std::size_t(pieces[i].Constraint)], at(pieces[i].A), at(pieces[i].B) });
      }
    }
    for (const CrossingPoint& crossing : resolved.Crossings)
    {
      result.Crossings.push_back(crossing.Position);
    }
    result.Rounds = resolved.Rounds;
  }

  void interpolate(const StoredConstraints::Ends& ends, const ResolvedConstraints& resolved,
    SplitConstraints& result) const
  {
    const std::size_t count = ends.Positions.size();
    std::vector<std::vector<double>> values(this->Columns, std::vector<double>(count));
    if (this->Columns > 0)
    {
      this->Constraints.lookUp(ends,
        [&](std::size_t end, PointId, const double* its)
        {
          for (std::size_t c = 0; c < this->Columns; ++c)
          {
            values[c][end] = its[c];
          }
        });
    }
    for (std::vector<double>& column : values)
    {
      column.resize(count + resolved.Crossings.size());
      interpolateTuples(resolved.Crossings, count, Scalar::Float64, 1, column.data());
      column.erase(column.begin(), column.begin() + std::ptrdiff_t(count));
    }
    result.Values = std::move(values);
  }

  const StoredConstraints& Constraints;
  const std::size_t Columns;
  const DiskWork& Work;
  const SegmentTiles Tiles;
};

} // namespace

SplitConstraints splitStored(const StoredConstraints& constraints, CrossingRule rule,
  std::size_t columns, const DiskWork& work)
{
  return Splitter(constraints, columns, work).split(rule);
}

} // namespace tipp
