// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/StoredConstraints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

Point2 keyOf(std::int64_t id)
{
  return { double(id), 0 };
}

} // namespace

StoredConstraints::StoredConstraints(
  DiskWork work, TableConstraints constraints, SegmentRows* lines, Columns columns)
  : Work(std::move(work))
  , Wanted(std::move(columns))
  , Vertices(std::make_unique<RowFile>(this->Work.Files + ".vertices", sizeof(Vertex)))
  , Keys(std::make_unique<RowFile>(this->Work.Files + ".ends", sizeof(Segment)))
{
  if (lines)
  {
    ConstraintTable part;
    while (lines->next(part))
    {
      this->store(part, this->AreLinesNamed);
    }
    this->PolygonBegin = this->Keys->count();
  }
  else
  {
    this->store(constraints.Lines, this->AreLinesNamed);
    this->PolygonBegin = std::int64_t(constraints.Lines.PolygonBegin);
    constraints.Lines = ConstraintTable();
  }
  this->BoundaryBegin = this->Keys->count();
  this->store(constraints.Boundary, this->IsBoundaryNamed);
  this->Vertices->finish();
  this->Keys->finish();
  this->wantVertices();
  this->wantNamed();
}

void StoredConstraints::store(const ConstraintTable& table, bool& isNamed)
{
  isNamed = table.XY.empty() && !table.Edges.empty();
  const auto positionOf = [&](std::int64_t vertex) {
    return Point2{ table.XY[2 * std::size_t(vertex)], table.XY[2 * std::size_t(vertex) + 1] };
  };
  for (std::size_t i = 0; 2 * i < table.XY.size(); ++i)
  {
    const Vertex vertex{ positionOf(std::int64_t(i)),
      i < table.Height.size() ? table.Height[i] : std::nan("") };
    this->Vertices->append(&vertex);
  }
  for (const auto& [a, b] : table.Edges)
  {
    const Segment segment =
      isNamed ? Segment{ keyOf(a), keyOf(b) } : Segment{ positionOf(a), positionOf(b) };
    this->Keys->append(&segment);
  }
}

void StoredConstraints::wantVertices()
{
  const std::int64_t count = this->Vertices->count();
  if (count == 0)
  {
    return;
  }
  this->IsNew.assign(std::size_t(count), false);
  this->Own = std::make_unique<PositionJoin>(this->Work.Files + ".own", count,
    1 + this->Wanted.Names.size(), this->Work.Memory, this->Work.Threads);
  this->Vertices->forEach<Vertex>(
    [&](std::int64_t number, const Vertex& vertex)
    {
      if (isFinite(vertex.Position))
      {
        this->Own->want(vertex.Position, number);
      }
      else
      {
        this->IsNew[std::size_t(number)] = true;
      }
    });
  this->Own->seal();
}

void StoredConstraints::wantNamed()
{
  if (!this->AreLinesNamed && !this->IsBoundaryNamed)
  {
    return;
  }
  this->Named = std::make_unique<PositionJoin>(this->Work.Files + ".named", 2 * this->count(),
    2 + this->Wanted.Names.size(), this->Work.Memory, this->Work.Threads);
  this->Keys->forEach<Segment>(
    [&](std::int64_t number, const Segment& segment)
    {
      if (this->isNamed(number))
      {
        this->Named->want(segment.A, 2 * number);
        this->Named->want(segment.B, 2 * number + 1);
      }
    });
  this->Named->seal();
}

void StoredConstraints::add(const PointBlock& block)
{
  const PointsView points(block.XY.data(), block.size(), 2);
  this->Points += std::int64_t(block.size());
  if (this->Own)
  {
    this->Own->add(points,
      [&block](std::size_t i, std::size_t c)
      { return c == 0 ? double(block.First + std::int64_t(i)) : block.Columns[c - 1][i]; });
  }
  if (this->Named)
  {
    std::vector<Point2> keys;
    keys.reserve(block.size());
    for (std::size_t i = 0; i < block.size(); ++i)
    {
      keys.push_back(keyOf(block.First + std::int64_t(i)));
    }
    this->Named->add(PointsView(keys),
      [&block](std::size_t i, std::size_t c)
      { return c < 2 ? block.XY[2 * i + c] : block.Columns[c - 2][i]; });
  }
}

void StoredConstraints::match()
{
  if (this->Own)
  {
    this->Own->finish();
    this->Own->forEachMatch(
      [this](const PositionJoin::Match& match)
      {
        if (!match.Values && match.First == match.Number)
        {
          this->IsNew[std::size_t(match.Number)] = true;
        }
      });
  }
  std::int64_t count = 0;
  for (std::size_t vertex = 0; vertex < this->IsNew.size(); ++vertex)
  {
    vertex % VerticesPerCount == 0 ? this->NewBefore.push_back(count) : void();
    count += this->IsNew[vertex] ? 1 : 0;
  }
  if (this->Named)
  {
    this->Named->finish();
    this->placeNamed();
  }
}

/// Writes the positions of all constraints. Matches by id arrive bucket by bucket, so they are
/// first sorted by ranges of constraints.
void StoredConstraints::placeNamed()
{
  struct End
  {
    std::int64_t Number; ///< twice the index of the constraint, plus 1 for its end B
    Point2 Position;
  };
  constexpr std::uint64_t fewest = 65536;
  const auto range =
    std::int64_t(std::max(fewest, this->Work.Memory / 16 / sizeof(Segment))); // constraints
  KeyedRows ends(this->Work.Files + ".placed", std::size_t(this->count() / range + 1), sizeof(End));
  double missing = std::numeric_limits<double>::infinity();
  this->Named->forEachMatch(
    [&](const PositionJoin::Match& match)
    {
      if (!match.Values)
      {
        missing = std::min(missing, match.Position.x);
        return;
      }
      const End end{ match.Number, { match.Values[0], match.Values[1] } };
      ends.add(std::size_t(match.Number / 2 / range), &end);
    });
  if (std::isfinite(missing))
  {
    throw std::invalid_argument("a constraint names point " +
      std::to_string(std::int64_t(missing)) + ", but there are " + std::to_string(this->Points) +
      " points, counted from 0.");
  }
  ends.finish();
  this->Places = std::make_unique<RowFile>(this->Work.Files + ".places", sizeof(Segment));
  for (std::int64_t first = 0; first < this->count(); first += range)
  {
    std::vector<Segment> segments(std::size_t(std::min(range, this->count() - first)));
    this->Keys->read(first, segments.size(), segments.data());
    ends.forEach(std::size_t(first / range),
      [&](const char* bytes)
      {
        End end;
        std::memcpy(&end, bytes, sizeof end);
        Segment& segment = segments[std::size_t(end.Number / 2 - first)];
        (end.Number % 2 == 0 ? segment.A : segment.B) = end.Position;
      });
    for (const Segment& segment : segments)
    {
      this->Places->append(&segment);
    }
  }
  this->Places->finish();
}

/// The number of new vertices before a vertex.
std::int64_t StoredConstraints::newBefore(std::int64_t vertex) const
{
  const std::size_t counted = std::size_t(vertex) / VerticesPerCount;
  const auto begin = this->IsNew.begin();
  return this->NewBefore[counted] +
    std::count(begin + std::ptrdiff_t(counted * VerticesPerCount), begin + vertex, true);
}

std::vector<double> StoredConstraints::valuesOf(std::int64_t number, const Vertex& vertex) const
{
  std::vector<double> values;
  for (std::size_t c = 0; c < this->Wanted.Names.size(); ++c)
  {
    const double given = isHeightColumn(this->Wanted.Names[c]) ? vertex.Height : std::nan("");
    values.push_back(std::isnan(given) && !this->Wanted.Surface.empty()
        ? this->Wanted.Surface.at(c).at(std::size_t(number))
        : given);
  }
  return values;
}

std::vector<double> StoredConstraints::valuesOf(std::int64_t number) const
{
  Vertex vertex;
  this->Vertices->read(number, 1, &vertex);
  return this->valuesOf(number, vertex);
}

void StoredConstraints::forEachNew(const std::function<void(Point2, const double*)>& visit) const
{
  this->Vertices->forEach<Vertex>(
    [&](std::int64_t number, const Vertex& vertex)
    {
      if (this->IsNew[std::size_t(number)])
      {
        visit(vertex.Position, this->valuesOf(number, vertex).data());
      }
    });
}

StoredConstraints::Ends StoredConstraints::endsOf(
  const std::function<bool(std::int64_t)>& isTaken) const
{
  struct Taken
  {
    bool IsNamed;
    Segment Keys;
    Segment Positions;
  };
  std::vector<Taken> taken;
  std::vector<Point2> own;
  std::vector<Point2> named;
  this->forEach(
    [&](std::int64_t number, Point2 a, Point2 b)
    {
      if (isTaken(number))
      {
        Taken one{ this->isNamed(number), { a, b }, { a, b } };
        one.IsNamed ? this->Keys->read(number, 1, &one.Keys) : void();
        std::vector<Point2>& keys = one.IsNamed ? named : own;
        keys.insert(keys.end(), { one.Keys.A, one.Keys.B });
        taken.push_back(one);
      }
    });
  std::sort(named.begin(), named.end(), [](Point2 a, Point2 b) { return a.x < b.x; }); // by id
  Ends ends;
  ends.OwnCount = own.size();
  ends.Positions = own;
  ends.Positions.resize(own.size() + named.size());
  ends.Own = std::make_unique<PositionIndex>(std::move(own));
  ends.Named = std::make_unique<PositionIndex>(std::move(named));
  for (const Taken& one : taken)
  {
    const auto indexOf = [&](Point2 key) {
      return one.IsNamed ? std::int64_t(ends.OwnCount) + ends.Named->find(key)
                         : ends.Own->find(key);
    };
    ends.Edges.push_back({ indexOf(one.Keys.A), indexOf(one.Keys.B) });
    if (one.IsNamed)
    {
      ends.Positions[std::size_t(ends.Edges.back().A)] = one.Positions.A;
      ends.Positions[std::size_t(ends.Edges.back().B)] = one.Positions.B;
    }
  }
  return ends;
}

void StoredConstraints::lookUp(
  const Ends& ends, const std::function<void(std::size_t, PointId, const double*)>& visit) const
{
  if (this->Own && ends.OwnCount > 0)
  {
    this->Own->forEachMatch(
      [&](const PositionJoin::Match& match)
      {
        const std::int64_t end = ends.Own->find(match.Position);
        if (end >= 0 && match.Values)
        {
          visit(std::size_t(end), PointId(match.Values[0]), match.Values + 1);
        }
        else if (end >= 0)
        {
          visit(std::size_t(end), this->Points + this->newBefore(match.First),
            this->valuesOf(match.First).data());
        }
      });
  }
  if (this->Named && ends.OwnCount < ends.Positions.size())
  {
    this->Named->forEachMatch(
      [&](const PositionJoin::Match& match)
      {
        const std::int64_t end = ends.Named->find(match.Position);
        if (end >= 0)
        {
          visit(ends.OwnCount + std::size_t(end), PointId(match.Position.x), match.Values + 2);
        }
      });
  }
}

} // namespace tipp
