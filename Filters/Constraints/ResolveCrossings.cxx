// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ResolveCrossings.h"

#include "Constraints/NearSegments.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Predicates/ExactArithmetic.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/PopulatePages.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

namespace tipp
{

namespace
{

/// By how much the box of points that round to p extends beyond the line through a and b, on its
/// left (`side` 1) or right (-1), as an exact sign. Negative if the whole box is on the other side.
int signOfReach(Point2 a, Point2 b, Point2 p, int side)
{
  const auto sign = [](double from, double to) { return to < from ? -1 : 1; };
  ProductSum<24, 106> sum;
  // Adds (from - to) times the extent of the box along an axis and, with a sign, times the
  // distance.
  const auto addAxis = [&](double from, double to, double at, double value, int offSign)
  {
    const double below = std::nextafter(value, -HUGE_VAL);
    const double above = std::nextafter(value, HUGE_VAL);
    for (const double end : { to, -from })
    {
      const auto add = [&](int factor, double other, int doublings)
      {
        BinaryNumber one = binaryNumber(factor * end);
        one.Exponent += doublings;
        sum.add(one, binaryNumber(other));
      };
      add(sign(from, to), above, 0);
      add(-sign(from, to), below, 0);
      add(-offSign, value, 1);
      add(-offSign, below, 0);
      add(-offSign, above, 0);
      add(offSign, at, 2);
    }
  };
  addAxis(a.x, b.x, a.y, p.y, side);
  addAxis(a.y, b.y, a.x, p.x, -side);
  return sum.sign();
}

/// Whether the line through a and b passes through the interior of the box of points that round to
/// p. Exact.
bool roundsTo(Point2 a, Point2 b, Point2 p)
{
  using Long = long double; // its exponent range holds all products
  struct RoundingInterval
  {
    explicit RoundingInterval(double value)
      : Below((Long(value) + std::nextafter(value, -HUGE_VAL)) / 2)
      , Above((Long(value) + std::nextafter(value, HUGE_VAL)) / 2)
    {
    }
    Long center() const { return (this->Below + this->Above) / 2; }
    Long half() const { return (this->Above - this->Below) / 2; }
    Long Below;
    Long Above;
  };
  const RoundingInterval x(p.x);
  const RoundingInterval y(p.y);
  if (!std::isfinite(x.half()) || !std::isfinite(y.half()))
  {
    return false; // next to the largest doubles
  }
  const Long dx = Long(b.x) - a.x;
  const Long dy = Long(b.y) - a.y;
  const Long off = std::fabs(dx * (y.center() - a.y) - dy * (x.center() - a.x));
  const Long reach = std::fabs(dx) * y.half() + std::fabs(dy) * x.half();
  const Long error = 16 * std::numeric_limits<Long>::epsilon() *
    (std::fabs(dx) * (std::fabs(y.center()) + std::fabs(Long(a.y))) +
      std::fabs(dy) * (std::fabs(x.center()) + std::fabs(Long(a.x))) + reach);
  if (std::fabs(off - reach) > error)
  {
    return off < reach;
  }
  return signOfReach(a, b, p, 1) > 0 && signOfReach(a, b, p, -1) > 0;
}

class Resolver
{
public:
  Resolver(
    PointsView points, ResolvedConstraints& result, int threads, const ConstraintNames& names)
    : Points(points)
    , Result(result)
    , Threads(threadCount(threads))
    , Names(names)
  {
  }

  void addSegments(const std::vector<Constraint>& constraints)
  {
    this->Given = &constraints;
    this->Result.Crosses.assign(constraints.size(), 0);
    std::vector<char> isTaken(constraints.size());
    constexpr std::size_t ahead = 32;
    this->Result.Segments.reserve(constraints.size());
    IdSegment* const segments = this->Result.Segments.data();
    this->Result.NotFinite =
      sumOfChunks(std::int64_t(constraints.size()), SegmentTree::Chunk, this->Threads,
        [&](std::int64_t begin, std::int64_t end)
        {
          std::int64_t notFinite = 0;
          // Faster than page faults when the segments are written below.
          populatePages(segments + begin, std::size_t(end - begin) * sizeof(IdSegment));
          for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
          {
            const Constraint& later = constraints[std::min(i + ahead, constraints.size() - 1)];
            this->Points.prefetch(std::size_t(later.A)); // points are anywhere in memory
            this->Points.prefetch(std::size_t(later.B));
            const Point2 a = this->checkedPoint(constraints[i].A, i);
            const Point2 b = this->checkedPoint(constraints[i].B, i);
            const bool areFinite = isFinite(a) && isFinite(b);
            notFinite += areFinite ? 0 : 1;
            isTaken[i] = char(areFinite && !(a == b));
          }
          return notFinite;
        });
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (isTaken[i])
      {
        this->Result.Segments.push_back({ constraints[i].A, constraints[i].B, std::int64_t(i) });
      }
    }
  }

  void resolve(CrossingRule rule)
  {
    const std::vector<IdSegment> wholes = this->Result.Segments;
    std::vector<CrossingPair> crossings = this->findCrossings();
    if (crossings.empty())
    {
      return;
    }
    for (const auto& [one, other] : crossings)
    {
      this->setCrosses(wholes[std::size_t(one)]);
      this->setCrosses(wholes[std::size_t(other)]);
    }
    this->splitAtPoints(wholes);
    crossings = this->Result.Segments.size() > wholes.size() ? this->findCrossings() : crossings;
    for (; !crossings.empty(); crossings = this->findCrossings())
    {
      if (rule == CrossingRule::Refuse)
      {
        this->refuse(crossings.front());
      }
      ++this->Result.Rounds;
      this->split(crossings);
    }
    this->mergeCrossings();
    this->restoreOthers(wholes);
  }

private:
  Point2 checkedPoint(PointId id, std::size_t constraint) const
  {
    if (id < 0 || std::size_t(id) >= this->Points.size())
    {
      throw std::invalid_argument("constraint " + std::to_string(constraint) + " names point " +
        std::to_string(id) + ", but there are " + std::to_string(this->Points.size()) +
        " points, counted from 0.");
    }
    return this->Points[std::size_t(id)];
  }

  Point2 at(PointId id) const
  {
    const std::size_t input = this->Points.size();
    return std::size_t(id) < input ? this->Points[std::size_t(id)]
                                   : this->Result.Crossings[std::size_t(id) - input].Position;
  }

  /// The segments with their ends' positions. Id: the index of the segment.
  std::vector<SegmentTree::Item> items() const
  {
    const std::vector<IdSegment>& segments = this->Result.Segments;
    std::vector<SegmentTree::Item> all(segments.size());
    forIndices(
      std::int64_t(all.size()),
      [&](std::int64_t i)
      {
        all[std::size_t(i)] = { this->at(segments[std::size_t(i)].A),
          this->at(segments[std::size_t(i)].B), i };
      },
      this->Threads, SegmentTree::Chunk);
    return all;
  }

  std::vector<CrossingPair> findCrossings() const
  {
    return findCrossingPairs(this->items(), this->Threads);
  }

  /// Splits the constraints at the points that lie exactly on them. These are vertices of the
  /// constraints, also of those that are led through other vertices afterwards.
  void splitAtPoints(const std::vector<IdSegment>& wholes)
  {
    std::vector<std::vector<PointId>> on(wholes.size());
    for (const auto& [segment, point] : findPointsOn(this->items(), this->Points, this->Threads))
    {
      on[segment].push_back(PointId(point));
    }
    this->Result.Segments.clear();
    for (std::size_t i = 0; i < wholes.size(); ++i)
    {
      this->appendParts(wholes[i], on[i]);
    }
  }

  void setCrosses(const IdSegment& segment)
  {
    this->Result.Crosses[std::size_t(segment.Constraint)] = 1;
  }

  /// Makes constraints that do not cross others whole again.
  void restoreOthers(const std::vector<IdSegment>& wholes)
  {
    std::vector<IdSegment> segments;
    auto next = this->Result.Segments.cbegin();
    for (const IdSegment& whole : wholes)
    {
      const auto end = std::find_if(next, this->Result.Segments.cend(),
        [&whole](const IdSegment& segment) { return segment.Constraint != whole.Constraint; });
      if (this->Result.Crosses[std::size_t(whole.Constraint)])
      {
        segments.insert(segments.end(), next, end);
      }
      else
      {
        segments.push_back(whole);
      }
      next = end;
    }
    this->Result.Segments = std::move(segments);
  }

  /// Replaces the crossings that are at points by these points.
  void mergeCrossings()
  {
    std::vector<CrossingPoint>& crossings = this->Result.Crossings;
    std::vector<Point2> positions;
    positions.reserve(crossings.size());
    std::transform(crossings.begin(), crossings.end(), std::back_inserter(positions),
      [](const CrossingPoint& crossing) { return crossing.Position; });
    const MatchedPositions matched = matchPositions(this->Points, PointsView(positions));
    const auto input = PointId(this->Points.size());
    const auto rename = [&](auto& part)
    {
      for (PointId* const id : { &part.A, &part.B })
      {
        *id = *id < input ? *id : matched.Ids[std::size_t(*id - input)];
      }
    };
    for (std::size_t i = 0; i < matched.New.size(); ++i)
    {
      crossings[i] = crossings[matched.New[i]];
      rename(crossings[i]);
    }
    crossings.resize(matched.New.size());
    std::for_each(this->Result.Segments.begin(), this->Result.Segments.end(), rename);
  }

  static std::string textOf(const std::vector<std::int64_t>& names, std::int64_t number)
  {
    return std::to_string(names.empty() ? number : names[std::size_t(number)]);
  }

  [[noreturn]] void refuse(const CrossingPair& crossing) const
  {
    const IdSegment& one = this->Result.Segments[std::size_t(crossing[0])];
    const IdSegment& other = this->Result.Segments[std::size_t(crossing[1])];
    const Point2 position =
      crossingPoint(this->at(one.A), this->at(one.B), this->at(other.A), this->at(other.B));
    const auto name = [this](PointId id) { return textOf(this->Names.Points, id); };
    const auto describe = [&](const IdSegment& segment)
    {
      const Constraint& whole = (*this->Given)[std::size_t(segment.Constraint)];
      return "constraint " + textOf(this->Names.Constraints, segment.Constraint) + " (points " +
        name(whole.A) + " and " + name(whole.B) + ")";
    };
    std::ostringstream text;
    text << describe(one) << " crosses " << describe(other) << " at (" << position.x << ", "
         << position.y << "): have crossings split, or remove one of the two.";
    throw std::invalid_argument(text.str());
  }

  /// The position of p on the segment ab, as a fraction.
  static double fraction(Point2 a, Point2 b, Point2 p)
  {
    // Halves, because a difference may overflow.
    const double dx = b.x / 2 - a.x / 2;
    const double dy = b.y / 2 - a.y / 2;
    const double part =
      std::fabs(dx) >= std::fabs(dy) ? (p.x / 2 - a.x / 2) / dx : (p.y / 2 - a.y / 2) / dy;
    return part > 0 ? std::min(part, 1.0) : 0;
  }

  /// The id of the point where two segments cross: an end of one of them, if the crossing rounds to
  /// it, or the point of another crossing at this position, or a new point.
  PointId pointOf(const CrossingPair& crossing)
  {
    const IdSegment& one = this->Result.Segments[std::size_t(crossing[0])];
    const IdSegment& other = this->Result.Segments[std::size_t(crossing[1])];
    const Point2 position = this->positionOf(one, other);
    for (const PointId end : { one.A, one.B, other.A, other.B })
    {
      if (this->at(end) == position)
      {
        return end;
      }
    }
    const PointId next = PointId(this->Points.size() + this->Result.Crossings.size());
    const auto [known, isNew] = this->Known.emplace(std::make_pair(position.x, position.y), next);
    if (isNew)
    {
      this->Result.Crossings.push_back(
        { position, one.A, one.B, fraction(this->at(one.A), this->at(one.B), position) });
    }
    return known->second;
  }

  /// The position where two segments cross, rounded to doubles, and after some rounds to a coarser
  /// grid.
  Point2 positionOf(const IdSegment& one, const IdSegment& other) const
  {
    const Point2 a = this->at(one.A);
    const Point2 b = this->at(one.B);
    const Point2 c = this->at(other.A);
    const Point2 d = this->at(other.B);
    const Point2 p = crossingPoint(a, b, c, d);
    const int coarser = this->Result.Rounds - RoundsOfDoubles;
    return coarser <= 0 ? p
                        : Point2{ rounded(p.x, { a.x, b.x }, { c.x, d.x }, coarser),
                            rounded(p.y, { a.y, b.y }, { c.y, d.y }, coarser) };
  }

  /// Rounds a coordinate of a crossing to a multiple of the largest end's unit in the last place,
  /// times a power of two. The result stays between the ends of both segments.
  static double rounded(
    double value, std::pair<double, double> one, std::pair<double, double> other, int coarser)
  {
    const auto [low, high] = std::minmax(one.first, one.second);
    const auto [itsLow, itsHigh] = std::minmax(other.first, other.second);
    const double largest =
      std::max({ std::fabs(low), std::fabs(high), std::fabs(itsLow), std::fabs(itsHigh) });
    constexpr int whole = 60; // at this size, everything rounds to 0
    const double unit =
      std::ldexp(largest - std::nextafter(largest, 0), std::min(coarser, whole) - 1);
    const double multiple = unit > 0 && std::isfinite(unit) ? std::nearbyint(value / unit) : 0;
    return std::clamp(
      multiple == 0 ? 0 : multiple * unit, std::max(low, itsLow), std::min(high, itsHigh));
  }

  void split(const std::vector<CrossingPair>& crossings)
  {
    std::vector<std::vector<PointId>> through(this->Result.Segments.size());
    for (const CrossingPair& crossing : crossings)
    {
      const PointId point = this->pointOf(crossing);
      through[std::size_t(crossing[0])].push_back(point);
      through[std::size_t(crossing[1])].push_back(point);
    }
    const std::vector<PointId> vertices = this->constraintVertices();
    std::vector<SegmentTree::Item> items;
    items.reserve(vertices.size());
    for (const PointId vertex : vertices)
    {
      items.push_back({ this->at(vertex), this->at(vertex), std::int64_t(items.size()) });
    }
    const SegmentTree tree(std::move(items));
    const std::vector<IdSegment> wholes = std::move(this->Result.Segments);
    this->Result.Segments.clear();
    for (std::size_t i = 0; i < wholes.size(); ++i)
    {
      const IdSegment& whole = wholes[i];
      std::vector<PointId>& points = through[i];
      if (!points.empty())
      {
        const SegmentTree::Item segment{ this->at(whole.A), this->at(whole.B), 0 };
        tree.visitNear(segment,
          [&](const SegmentTree::Item& item)
          {
            if (roundsTo(segment.A, segment.B, item.A))
            {
              points.push_back(vertices[std::size_t(item.Id)]);
            }
            return true;
          });
      }
      if (this->appendParts(whole, points) > 1)
      {
        this->setCrosses(whole);
      }
    }
  }

  /// The vertices of all constraints: ends and crossings.
  std::vector<PointId> constraintVertices() const
  {
    std::vector<PointId> vertices;
    for (const IdSegment& segment : this->Result.Segments)
    {
      vertices.push_back(segment.A);
      vertices.push_back(segment.B);
    }
    for (std::size_t i = 0; i < this->Result.Crossings.size(); ++i)
    {
      vertices.push_back(PointId(this->Points.size() + i));
    }
    sortUnique(vertices);
    return vertices;
  }

  /// Appends the parts of a segment that is led through these points. Returns their number.
  /// Rounding keeps the order of both coordinates along a segment, so points are sorted by them.
  std::size_t appendParts(const IdSegment& whole, std::vector<PointId>& points)
  {
    const std::size_t before = this->Result.Segments.size();
    const Point2 a = this->at(whole.A);
    const Point2 b = this->at(whole.B);
    const double signX = b.x < a.x ? -1 : 1;
    const double signY = b.y < a.y ? -1 : 1;
    const auto along = [&](PointId id)
    {
      const Point2 p = this->at(id);
      return std::make_tuple(signX * p.x, signY * p.y, id);
    };
    std::sort(
      points.begin(), points.end(), [&](PointId p, PointId q) { return along(p) < along(q); });
    PointId from = whole.A;
    for (const PointId to : points)
    {
      if (!(this->at(to) == this->at(from)) && !(this->at(to) == b))
      {
        this->Result.Segments.push_back({ from, to, whole.Constraint });
        from = to;
      }
    }
    this->Result.Segments.push_back({ from, whole.B, whole.Constraint });
    return this->Result.Segments.size() - before;
  }

  PointsView Points;
  ResolvedConstraints& Result;
  const int Threads;
  const ConstraintNames& Names;
  const std::vector<Constraint>* Given = nullptr;
  std::map<std::pair<double, double>, PointId> Known; ///< crossings by position
};

} // namespace

ResolvedConstraints takeConstraints(
  PointsView points, const std::vector<Constraint>& constraints, int threads)
{
  ResolvedConstraints result;
  Resolver(points, result, threads, {}).addSegments(constraints);
  return result;
}

ResolvedConstraints resolveCrossings(PointsView points, const std::vector<Constraint>& constraints,
  CrossingRule rule, int threads, const ConstraintNames& names)
{
  ResolvedConstraints result;
  Resolver resolver(points, result, threads, names);
  resolver.addSegments(constraints);
  resolver.resolve(rule);
  return result;
}

} // namespace tipp
