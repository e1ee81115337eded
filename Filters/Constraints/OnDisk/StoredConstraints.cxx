// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/StoredConstraints.h"

#include "Arrays/Concatenated.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{

namespace
{

/// The number of 64-bit words, a power of two: 16 bits per position, if memory allows.
std::size_t wordsFor(std::int64_t wanted, std::uint64_t memory)
{
  constexpr std::uint64_t perWord = 4;
  const std::uint64_t most = std::max<std::uint64_t>(1, memory / 16 / sizeof(std::uint64_t));
  std::size_t words = 1;
  while (words < std::uint64_t(wanted) / perWord && 2 * words <= most)
  {
    words *= 2;
  }
  return words;
}

std::size_t bucketsFor(
  std::int64_t wanted, std::size_t columns, std::uint64_t memory, std::size_t most)
{
  // Position and number, the point's row, and the entry in an index.
  const std::uint64_t each = 24 + 8 + 8 * columns + 36;
  const std::uint64_t share = std::max<std::uint64_t>(1, memory / 16);
  return std::size_t(std::clamp<std::uint64_t>(std::uint64_t(wanted) * each / share, 1, most));
}

/// The key of a point that is named by its id.
Point2 keyOf(std::int64_t id)
{
  return { double(id), 0 };
}

} // namespace

PositionJoin::PositionJoin(const std::string& file, std::int64_t wanted, std::size_t columns,
  std::uint64_t memory, int threads)
  : Columns(columns)
  , Threads(threads)
  , Mask(wordsFor(wanted, memory) - 1)
  , Bits(std::size_t(this->Mask) + 1, 0)
  , Positions(
      file + ".wanted", bucketsFor(wanted, columns, memory, MostBuckets), sizeof(WantedPosition))
  , Candidates(file + ".points", this->Positions.keys(), (2 + columns) * sizeof(double))
{
}

void PositionJoin::want(Point2 position, std::int64_t number)
{
  const std::uint64_t hash = PositionIndex::hashOf(position);
  this->wordOf(hash) |= bitsOf(hash);
  const WantedPosition wanted{ position, number };
  this->Positions.add(this->bucketOf(position), &wanted);
}

void PositionJoin::seal()
{
  this->Positions.finish();
}

/// The indices of points whose hash passes the filter.
std::vector<std::size_t> PositionJoin::mayMatch(PointsView points)
{
  constexpr std::int64_t chunk = 8192;
  constexpr std::size_t group = 32; // number of hashes prefetched at a time
  const auto count = std::int64_t(points.size());
  std::vector<std::vector<std::size_t>> found(std::size_t((count + chunk - 1) / chunk));
  const auto look =
    [&](const Point2* block, std::size_t first, std::size_t size, std::vector<std::size_t>& matches)
  {
    std::array<std::uint64_t, group> hashes;
    for (std::size_t i = 0; i < size; ++i)
    {
      hashes[i] = PositionIndex::hashOf(block[i]);
      __builtin_prefetch(&this->wordOf(hashes[i]));
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::uint64_t bits = bitsOf(hashes[i]);
      if ((this->wordOf(hashes[i]) & bits) == bits)
      {
        matches.push_back(first + i);
      }
    }
  };
  forChunks(count, chunk, this->Threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      points.forBlocks(std::size_t(begin), std::size_t(end),
        [&](std::size_t first, const Point2* block, std::size_t some)
        {
          for (std::size_t at = 0; at < some; at += group)
          {
            look(block + at, first + at, std::min(group, some - at),
              found[std::size_t(begin / chunk)]);
          }
        });
    });
  return concatenated(found);
}

void PositionJoin::finish()
{
  this->Candidates.finish();
  std::vector<std::uint64_t>().swap(this->Bits);
}

void PositionJoin::forEachMatch(const std::function<void(const Match&)>& visit) const
{
  for (std::size_t bucket = 0; bucket < this->Positions.keys(); ++bucket)
  {
    this->matchBucket(bucket, visit);
  }
}

void PositionJoin::matchBucket(
  std::size_t bucket, const std::function<void(const Match&)>& visit) const
{
  const std::vector<WantedPosition> wanted = this->Positions.readAll<WantedPosition>(bucket);
  std::vector<Point2> positions;
  positions.reserve(wanted.size());
  std::transform(wanted.begin(), wanted.end(), std::back_inserter(positions),
    [](const WantedPosition& one) { return one.Position; });
  const PositionIndex index(std::move(positions));
  constexpr std::int64_t none = -1;
  std::vector<std::int64_t> rowOf(wanted.size(), none); // row of the first point at each position
  std::vector<double> rows;
  std::int64_t count = 0;
  const std::size_t words = this->Columns + 1; // at least one word per row
  this->Candidates.forEach(bucket,
    [&](const char* bytes)
    {
      Point2 position;
      std::memcpy(&position, bytes, sizeof position);
      const std::int64_t at = index.find(position);
      if (at >= 0 && rowOf[std::size_t(at)] == none)
      {
        rowOf[std::size_t(at)] = count++;
        rows.resize(std::size_t(count) * words);
        std::memcpy(
          &rows[rows.size() - words], bytes + sizeof position, this->Columns * sizeof(double));
      }
    });
  for (const WantedPosition& one : wanted)
  {
    const auto first = std::size_t(index.find(one.Position));
    visit({ one.Position, one.Number, wanted[first].Number,
      rowOf[first] == none ? nullptr : &rows[std::size_t(rowOf[first]) * words] });
  }
}

StoredConstraints::StoredConstraints(
  DiskWork work, TableConstraints constraints, SegmentRows* lines, Columns columns)
  : Work(std::move(work))
  , PointColumns(std::move(columns))
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
    1 + this->PointColumns.Names.size(), this->Work.Memory, this->Work.Threads);
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
    2 + this->PointColumns.Names.size(), this->Work.Memory, this->Work.Threads);
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
    if (vertex % VerticesPerCount == 0)
    {
      this->NewBefore.push_back(count);
    }
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
  for (std::size_t c = 0; c < this->PointColumns.Names.size(); ++c)
  {
    const double given = isHeightColumn(this->PointColumns.Names[c]) ? vertex.Height : std::nan("");
    values.push_back(std::isnan(given) && !this->PointColumns.Surface.empty()
        ? this->PointColumns.Surface.at(c).at(std::size_t(number))
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
  struct TakenConstraint
  {
    bool IsNamed;
    Segment Keys;
    Segment Positions;
  };
  std::vector<TakenConstraint> taken;
  std::vector<Point2> own;
  std::vector<Point2> named;
  this->forEach(
    [&](std::int64_t number, Point2 a, Point2 b)
    {
      if (isTaken(number))
      {
        TakenConstraint one{ this->isNamed(number), { a, b }, { a, b } };
        if (one.IsNamed)
        {
          this->Keys->read(number, 1, &one.Keys);
        }
        std::vector<Point2>& keys = one.IsNamed ? named : own;
        keys.insert(keys.end(), { one.Keys.A, one.Keys.B });
        taken.push_back(one);
      }
    });
  std::sort(named.begin(), named.end(), [](Point2 a, Point2 b) { return a.x < b.x; }); // by id
  Ends ends;
  ends.OwnCount = own.size();
  ends.Positions = own;
  ends.Positions.resize(own.size() + named.size(), { std::nan(""), std::nan("") });
  ends.Own = std::make_unique<PositionIndex>(std::move(own));
  ends.Named = std::make_unique<PositionIndex>(std::move(named));
  for (const TakenConstraint& one : taken)
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
