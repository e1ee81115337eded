// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/SplitStored.h"

#include "Constraints/ConstraintEdges.h"
#include "Constraints/NearSegments.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/SurfaceValues.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/StreamSampler.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace tipp
{

SegmentTiles::SegmentTiles(
  const std::string& file, const std::function<void(const Visit&)>& forEach, int tiles, int threads)
  : Threads(threads)
{
  Box2 domain = Box2::empty();
  StreamSampler<Point2> sampler(SamplesPerPartition * std::size_t(tiles), -1);
  std::int64_t count = 0;
  std::vector<Point2> middle(1);
  forEach(
    [&](const SegmentTree::Item& item)
    {
      domain.extend(item.box());
      middle[0] = { item.A.x / 2 + item.B.x / 2, item.A.y / 2 + item.B.y / 2 };
      sampler.add(count++, middle);
    });
  std::vector<Point2> sample;
  for (const auto& [number, position] : sampler.take())
  {
    sample.push_back(position);
  }
  constexpr double relative = 0x1p-44; // relative to the largest coordinate
  this->Margin = count == 0 ? 0 : relative * domain.largest();
  this->Boxes = count == 0 ? Tiling::grid({ { 0, 0 }, { 0, 0 } }, 1, 1)
                           : Tiling::balanced(domain, std::move(sample), tiles);
  this->Rows = std::make_unique<KeyedRows>(
    file + ".tiles", std::size_t(this->Boxes.size()), sizeof(SegmentTree::Item));
  forEach(
    [&](const SegmentTree::Item& item)
    {
      this->Boxes.visitNear(expanded(item.box(), this->Margin),
        [&](PartitionIndex tile)
        {
          if (lineMayMeet(item.A, item.B, expanded(this->Boxes.box(tile), this->Margin)))
          {
            this->Rows->add(std::size_t(tile), &item);
          }
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
          if (lineMayMeet(item.A, item.B, expanded(other.box(), this->Margin)))
          {
            near(other.Id);
          }
          return true;
        },
        this->Margin);
    }
  }
}

namespace
{

/// A segment's ends in lexicographic order.
std::pair<Point2, Point2> orderedEnds(const SegmentTree::Item& segment)
{
  return lexicographicLess(segment.A, segment.B) ? std::make_pair(segment.A, segment.B)
                                                 : std::make_pair(segment.B, segment.A);
}

/// Whether the lower segment of two on one line counts as the first.
bool isFirst(const SegmentTree::Item& one, const SegmentTree::Item& other)
{
  const auto [low, high] = orderedEnds(one);
  const auto [otherLow, otherHigh] = orderedEnds(other);
  if (!(low == otherLow))
  {
    return lexicographicLess(low, otherLow);
  }
  return high == otherHigh ? one.Id < other.Id : lexicographicLess(otherHigh, high);
}

/// The end of the part that earlier segments cover; the lower end if there is none.
Point2 endOfCovered(const SegmentTree::Item& segment, const NearSegments& all)
{
  const auto [low, high] = orderedEnds(segment);
  Point2 end = low;
  all.visitOn(low,
    [&, high = high](std::size_t i)
    {
      const SegmentTree::Item& other = all.segments()[i];
      const auto [otherLow, otherHigh] = orderedEnds(other);
      if (isFirst(other, segment) && lexicographicLess(end, otherHigh) &&
        orientation(otherLow, otherHigh, high) == 0)
      {
        end = lexicographicLess(high, otherHigh) ? high : otherHigh;
      }
    });
  return end;
}

} // namespace

void SegmentTiles::findCovered(const std::function<void(std::int64_t, Point2)>& covered) const
{
  for (std::size_t tile = 0; tile < this->Rows->keys(); ++tile)
  {
    std::vector<SegmentTree::Item> items = this->Rows->readAll<SegmentTree::Item>(tile);
    const auto isHere = [&](const SegmentTree::Item& item) // in one tile only
    { return std::size_t(this->Boxes.locate(orderedEnds(item).first)) == tile; };
    // Many segments may be equal, so only the first of them is compared with others.
    std::sort(items.begin(), items.end(), isFirst);
    std::vector<SegmentTree::Item> differing;
    for (const SegmentTree::Item& item : items)
    {
      if (differing.empty() || !(orderedEnds(differing.back()) == orderedEnds(item)))
      {
        differing.push_back(item);
      }
      else if (isHere(item))
      {
        covered(item.Id, orderedEnds(item).second);
      }
    }
    const NearSegments all(std::move(differing), this->Threads);
    const std::vector<SegmentTree::Item>& distinct = all.segments();
    std::vector<Point2> ends(distinct.size());
    constexpr std::int64_t chunk = 256;
    forIndices(
      std::int64_t(distinct.size()),
      [&](std::int64_t i)
      {
        ends[std::size_t(i)] = isHere(distinct[std::size_t(i)])
          ? endOfCovered(distinct[std::size_t(i)], all)
          : orderedEnds(distinct[std::size_t(i)]).first;
      },
      this->Threads, chunk);
    for (std::size_t i = 0; i < distinct.size(); ++i)
    {
      if (!(ends[i] == orderedEnds(distinct[i]).first))
      {
        covered(distinct[i].Id, ends[i]);
      }
    }
  }
}

int SegmentTiles::tilesFor(std::int64_t segments, std::uint64_t memory)
{
  constexpr std::uint64_t each = 128; // bytes of a segment and its tree
  constexpr std::uint64_t most = 4096;
  const std::uint64_t share = std::max<std::uint64_t>(1, memory / 16);
  return int(std::clamp<std::uint64_t>(std::uint64_t(segments) * each / share, 1, most));
}

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

/// Points of the stream, the first one at each position, in the order of their ids.
struct FoundPoints
{
  std::vector<Point2> Positions;
  std::vector<PointId> Ids;
  std::vector<std::vector<double>> Values; ///< by column
};

/// Constraints that are split in memory. Their vertices are the found points, and then their ends.
struct TakenConstraints
{
  std::vector<std::int64_t> Numbers;
  StoredConstraints::Ends Ends;
  FoundPoints Points;
  std::vector<Point2> Positions; ///< of the vertices
  std::vector<Constraint> Edges; ///< between vertices, one per constraint
};

class Splitter
{
public:
  Splitter(const StoredConstraints& constraints, const VisitBlocks& forEachBlock,
    std::size_t columns, const DiskWork& work)
    : Constraints(constraints)
    , ForEachBlock(forEachBlock)
    , Columns(columns)
    , Work(work)
    , Tiles(
        work.Files, [&](const SegmentTiles::Visit& visit) { forEachWhole(constraints, visit); },
        SegmentTiles::tilesFor(constraints.count(), work.Memory), work.Threads)
  {
  }

  SplitConstraints split(CrossingRule rule)
  {
    Marks crossing(std::size_t(this->Constraints.count()), false);
    bool isAny = false;
    this->Tiles.findCrossings(
      [&](std::int64_t one, std::int64_t other)
      {
        crossing[std::size_t(one)] = crossing[std::size_t(other)] = true;
        isAny = true;
      });
    return isAny ? this->splitNear(std::move(crossing), rule) : SplitConstraints();
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

  /// Loads the marked constraints, and the points near them or at one of `others`.
  TakenConstraints take(const Marks& isTaken, const std::vector<Point2>& others) const
  {
    TakenConstraints taken;
    for (std::size_t i = 0; i < isTaken.size(); ++i)
    {
      if (isTaken[i])
      {
        taken.Numbers.push_back(std::int64_t(i));
      }
    }
    taken.Ends =
      this->Constraints.endsOf([&](std::int64_t number) { return isTaken[std::size_t(number)]; });
    const std::vector<Point2>& ends = taken.Ends.Positions;
    std::vector<SegmentTree::Item> items;
    items.reserve(taken.Ends.Edges.size());
    for (const Constraint& edge : taken.Ends.Edges)
    {
      items.push_back({ ends[std::size_t(edge.A)], ends[std::size_t(edge.B)], 0 });
    }
    taken.Points = this->findPoints(
      NearSegments(std::move(items), this->Work.Threads, this->Tiles.margin()), others);
    // Found points come first, because of equal vertices the one with the lowest id is used.
    taken.Positions = taken.Points.Positions;
    taken.Positions.insert(taken.Positions.end(), ends.begin(), ends.end());
    const auto found = PointId(taken.Points.Positions.size());
    for (const Constraint& edge : taken.Ends.Edges)
    {
      taken.Edges.push_back({ found + edge.A, found + edge.B });
    }
    return taken;
  }

  FoundPoints findPoints(const NearSegments& segments, const std::vector<Point2>& others) const
  {
    const PositionIndex index(others);
    FoundPoints found;
    found.Values.resize(this->Columns);
    std::set<std::pair<double, double>> known;
    std::vector<char> isFound;
    this->ForEachBlock(
      [&](const PointBlock& block)
      {
        const PointsView points(block.XY.data(), block.size(), 2);
        isFound.assign(block.size(), 0);
        constexpr std::int64_t chunk = 4096;
        forChunks(std::int64_t(block.size()), chunk, this->Work.Threads, {},
          [&](std::int64_t begin, std::int64_t end, int)
          {
            points.forEach(std::size_t(begin), std::size_t(end),
              [&](std::size_t i, Point2 p)
              { isFound[i] = char(isFinite(p) && (segments.isNear(p) || index.find(p) >= 0)); });
          });
        for (std::size_t i = 0; i < block.size(); ++i)
        {
          const Point2 p = points[i];
          if (isFound[i] != 0 && known.emplace(p.x, p.y).second)
          {
            found.Positions.push_back(p);
            found.Ids.push_back(block.First + PointId(i));
            for (std::size_t c = 0; c < this->Columns; ++c)
            {
              found.Values[c].push_back(block.Columns[c][i]);
            }
          }
        }
      });
    return found;
  }

  /// How messages name the vertices and constraints.
  ConstraintNames namesOf(const TakenConstraints& taken) const
  {
    ConstraintNames names{ taken.Points.Ids, taken.Numbers };
    const std::size_t found = names.Points.size();
    names.Points.resize(taken.Positions.size());
    this->Constraints.lookUp(taken.Ends,
      [&](std::size_t end, PointId id, const double*) { names.Points[found + end] = id; });
    return names;
  }

  /// `crossing` marks all constraints that cross others. In a round, parts of these move by at most
  /// a unit. So constraints that they newly cross are near them, and these may be led through
  /// points near themselves. Once such a constraint is split at a crossing, it counts as crossing.
  /// No other constraint can change. After many rounds they may move far, and a crossing may be at
  /// any point.
  SplitConstraints splitNear(Marks crossing, CrossingRule rule) const
  {
    bool isAll = false;
    std::vector<Point2> others;
    for (;;)
    {
      const TakenConstraints taken =
        this->take(isAll ? this->allWhole() : this->near(this->near(crossing)), others);
      const bool isRefused = rule == CrossingRule::Refuse;
      const ResolvedConstraints resolved =
        resolveCrossings(PointsView(taken.Positions), taken.Edges, rule, this->Work.Threads,
          isRefused ? this->namesOf(taken) : ConstraintNames());
      if (!isAll && resolved.Rounds > RoundsOfDoubles)
      {
        isAll = true;
        continue;
      }
      if (isAll && others.empty() && !resolved.Crossings.empty())
      {
        std::transform(resolved.Crossings.begin(), resolved.Crossings.end(),
          std::back_inserter(others),
          [](const CrossingPoint& crossed) { return crossed.Position; });
        continue;
      }
      bool isComplete = true;
      for (std::size_t i = 0; i < taken.Numbers.size(); ++i)
      {
        const auto number = std::size_t(taken.Numbers[i]);
        isComplete = isComplete && (!resolved.Crosses[i] || crossing[number]);
        crossing[number] = crossing[number] || resolved.Crosses[i];
      }
      if (isAll || isComplete)
      {
        return this->result(taken, resolved);
      }
    }
  }

  SplitConstraints result(const TakenConstraints& taken, const ResolvedConstraints& resolved) const
  {
    SplitConstraints result;
    const auto at = [&](PointId id)
    {
      const auto i = std::size_t(id);
      return i < taken.Positions.size() ? taken.Positions[i]
                                        : resolved.Crossings[i - taken.Positions.size()].Position;
    };
    for (const IdSegment& segment : resolved.Segments)
    {
      if (resolved.Crosses[std::size_t(segment.Constraint)])
      {
        result.Parts.push_back(
          { taken.Numbers[std::size_t(segment.Constraint)], at(segment.A), at(segment.B) });
      }
    }
    for (const CrossingPoint& crossed : resolved.Crossings)
    {
      result.Crossings.push_back(crossed.Position);
    }
    result.Rounds = resolved.Rounds;
    this->interpolate(taken, resolved, result);
    return result;
  }

  void interpolate(const TakenConstraints& taken, const ResolvedConstraints& resolved,
    SplitConstraints& result) const
  {
    const std::size_t found = taken.Points.Positions.size();
    const std::size_t count = taken.Positions.size();
    std::vector<std::vector<double>> values = taken.Points.Values;
    for (std::vector<double>& column : values)
    {
      column.resize(count);
    }
    if (this->Columns > 0)
    {
      this->Constraints.lookUp(taken.Ends,
        [&](std::size_t end, PointId, const double* row)
        {
          for (std::size_t c = 0; c < this->Columns; ++c)
          {
            values[c][found + end] = row[c];
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
  const VisitBlocks& ForEachBlock;
  const std::size_t Columns;
  const DiskWork& Work;
  const SegmentTiles Tiles;
};

} // namespace

SplitConstraints splitStored(const StoredConstraints& constraints, const VisitBlocks& forEachBlock,
  CrossingRule rule, std::size_t columns, const DiskWork& work)
{
  return Splitter(constraints, forEachBlock, columns, work).split(rule);
}

} // namespace tipp
