// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/SplitStored.h"

#include "Constraints/OnDisk/SegmentTiles.h"
#include "Predicates/Points.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

using Marks = std::vector<bool>; ///< by index of the constraint

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
        this->countWhole(), SegmentTiles::tilesFor(constraints.count(), work.Memory), work.Threads)
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
  std::int64_t countWhole() const
  {
    std::int64_t count = 0;
    forEachWhole(this->Constraints, [&count](const SegmentTree::Item&) { ++count; });
    return count;
  }

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
      for (const CrossingPoint& crossing : resolved.Crossings)
      {
        column.push_back((1 - crossing.Fraction) * column[std::size_t(crossing.A)] +
          crossing.Fraction * column[std::size_t(crossing.B)]);
      }
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
