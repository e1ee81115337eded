// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ResolveCrossings.h"

#include "Constraints/SegmentTree.h"
#include "Parallel/ForChunks.h"
#include "Predicates/SegmentCrossing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// Two pieces that cross; the lower number first.
using Crossing = std::array<std::int64_t, 2>;

class Resolver
{
public:
  Resolver(PointsView points, ResolvedConstraints& result, int threads)
    : Points(points)
    , Result(result)
    , Threads(threads)
  {
  }

  void addPieces(const std::vector<Constraint>& constraints)
  {
    this->Result.Pieces.reserve(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const Constraint& constraint = constraints[i];
      const Point2 a = this->checkedPoint(constraint.A, i);
      const Point2 b = this->checkedPoint(constraint.B, i);
      if (!isFinite(a) || !isFinite(b))
      {
        ++this->Result.NotFinite;
      }
      else if (a == b)
      {
        ++this->Result.ZeroLength;
      }
      else
      {
        this->Result.Pieces.push_back({ constraint.A, constraint.B, std::int64_t(i) });
      }
    }
  }

  void resolve(CrossingRule rule)
  {
    for (std::vector<Crossing> crossings = this->findCrossings(); !crossings.empty();
         crossings = this->findCrossings())
    {
      if (rule == CrossingRule::Refuse)
      {
        this->refuse(crossings.front());
      }
      if (++this->Result.Rounds > MostRounds)
      {
        throw std::invalid_argument(
          "constraints that lie within a unit in the last place of each other still cross after " +
          std::to_string(MostRounds) + " rounds of splitting: remove some of them.");
      }
      this->split(crossings);
    }
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

  /// Sorted.
  std::vector<Crossing> findCrossings() const
  {
    const std::vector<ConstraintPiece>& pieces = this->Result.Pieces;
    std::vector<SegmentTree::Item> items;
    items.reserve(pieces.size());
    for (const ConstraintPiece& piece : pieces)
    {
      items.push_back({ this->at(piece.A), this->at(piece.B), 0 });
    }
    const SegmentTree tree(std::move(items));
    std::vector<std::vector<Crossing>> found(std::size_t(this->Threads));
    constexpr std::int64_t chunk = 1024;
    forChunks(std::int64_t(pieces.size()), chunk, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int thread)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          this->findCrossings(tree, tree.items()[std::size_t(i)], found[std::size_t(thread)]);
        }
      });
    std::vector<Crossing> all;
    for (const std::vector<Crossing>& part : found)
    {
      all.insert(all.end(), part.begin(), part.end());
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  void findCrossings(
    const SegmentTree& tree, const SegmentTree::Item& one, std::vector<Crossing>& found) const
  {
    const ConstraintPiece& piece = this->Result.Pieces[std::size_t(one.Id)];
    tree.visitNear(one,
      [&](const SegmentTree::Item& other)
      {
        const ConstraintPiece& its = this->Result.Pieces[std::size_t(other.Id)];
        const bool isConnected =
          piece.A == its.A || piece.A == its.B || piece.B == its.A || piece.B == its.B;
        if (one.Id < other.Id && !isConnected && crossProperly(one.A, one.B, other.A, other.B))
        {
          found.push_back({ one.Id, other.Id });
        }
        return true;
      });
  }

  [[noreturn]] void refuse(const Crossing& crossing) const
  {
    const ConstraintPiece& one = this->Result.Pieces[std::size_t(crossing[0])];
    const ConstraintPiece& other = this->Result.Pieces[std::size_t(crossing[1])];
    const Point2 position =
      crossingPoint(this->at(one.A), this->at(one.B), this->at(other.A), this->at(other.B));
    const auto describe = [](const ConstraintPiece& piece)
    {
      return "constraint " + std::to_string(piece.Constraint) + " (points " +
        std::to_string(piece.A) + " and " + std::to_string(piece.B) + ")";
    };
    std::ostringstream text;
    text << describe(one) << " crosses " << describe(other) << " at (" << position.x << ", "
         << position.y << "): have crossings split, or remove one of the two.";
    throw std::invalid_argument(text.str());
  }

  /// How far p is from a to b, for a p between them.
  static double fraction(Point2 a, Point2 b, Point2 p)
  {
    // Halves, since a difference may overflow.
    const double dx = b.x / 2 - a.x / 2;
    const double dy = b.y / 2 - a.y / 2;
    const double part =
      std::fabs(dx) >= std::fabs(dy) ? (p.x / 2 - a.x / 2) / dx : (p.y / 2 - a.y / 2) / dy;
    return part > 0 ? std::min(part, 1.0) : 0;
  }

  /// The id of the point where the two cross: an end of one of them, if it is rounded to that, else
  /// a new one, or that of another crossing at the same position.
  PointId pointOf(const Crossing& crossing)
  {
    const ConstraintPiece& one = this->Result.Pieces[std::size_t(crossing[0])];
    const ConstraintPiece& other = this->Result.Pieces[std::size_t(crossing[1])];
    const Point2 position =
      crossingPoint(this->at(one.A), this->at(one.B), this->at(other.A), this->at(other.B));
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
        { position, one.A, one.B, fraction(this->at(one.A), this->at(one.B), position),
          { one.Constraint, other.Constraint } });
    }
    return known->second;
  }

  void split(const std::vector<Crossing>& crossings)
  {
    std::vector<std::vector<PointId>> through(this->Result.Pieces.size());
    for (const Crossing& crossing : crossings)
    {
      const PointId point = this->pointOf(crossing);
      through[std::size_t(crossing[0])].push_back(point);
      through[std::size_t(crossing[1])].push_back(point);
    }
    const std::vector<PointId> vertices = this->constraintVertices();
    std::vector<SegmentTree::Item> items;
    for (const PointId vertex : vertices)
    {
      items.push_back({ this->at(vertex), this->at(vertex), 0 });
    }
    const SegmentTree tree(std::move(items));
    const std::vector<ConstraintPiece> wholes = std::move(this->Result.Pieces);
    this->Result.Pieces.clear();
    for (std::size_t i = 0; i < wholes.size(); ++i)
    {
      const ConstraintPiece& whole = wholes[i];
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
      this->appendParts(whole, points);
    }
  }

  /// Ends and crossings.
  std::vector<PointId> constraintVertices() const
  {
    std::vector<PointId> vertices;
    for (const ConstraintPiece& piece : this->Result.Pieces)
    {
      vertices.push_back(piece.A);
      vertices.push_back(piece.B);
    }
    for (std::size_t i = 0; i < this->Result.Crossings.size(); ++i)
    {
      vertices.push_back(PointId(this->Points.size() + i));
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  /// Whether the line through a and b passes through the box of points that are rounded to p; with
  /// a small error at its border.
  static bool roundsTo(Point2 a, Point2 b, Point2 p)
  {
    using Long = long double; // its digits hold halves, its exponents all products
    struct Range
    {
      explicit Range(double value)
        : Below((Long(value) + std::nextafter(value, -HUGE_VAL)) / 2)
        , Above((Long(value) + std::nextafter(value, HUGE_VAL)) / 2)
      {
      }
      Long center() const { return (this->Below + this->Above) / 2; }
      Long half() const { return (this->Above - this->Below) / 2; }
      Long Below;
      Long Above;
    };
    const Range x(p.x);
    const Range y(p.y);
    const Long dx = Long(b.x) - a.x;
    const Long dy = Long(b.y) - a.y;
    const Long off = dx * (y.center() - a.y) - dy * (x.center() - a.x);
    return std::fabs(off) < std::fabs(dx) * y.half() + std::fabs(dy) * x.half();
  }

  /// Rounding keeps the order of both coordinates along a segment.
  void appendParts(const ConstraintPiece& whole, std::vector<PointId>& points)
  {
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
        this->Result.Pieces.push_back({ from, to, whole.Constraint });
        from = to;
      }
    }
    this->Result.Pieces.push_back({ from, whole.B, whole.Constraint });
  }

  static constexpr int MostRounds = 100;

  PointsView Points;
  ResolvedConstraints& Result;
  const int Threads;
  std::map<std::pair<double, double>, PointId> Known; ///< crossings by position
};

} // namespace

ResolvedConstraints resolveCrossings(
  PointsView points, const std::vector<Constraint>& constraints, CrossingRule rule, int threads)
{
  ResolvedConstraints result;
  Resolver resolver(points, result, threads);
  resolver.addPieces(constraints);
  resolver.resolve(rule);
  return result;
}

} // namespace tipp
