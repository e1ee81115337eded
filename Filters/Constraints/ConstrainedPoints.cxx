// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstrainedPoints.h"

#include "Constraints/ConstraintPoints.h"
#include "Constraints/KeepInside.h"
#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace tipp
{

/// A hash of what the constraints are.
std::string identityOf(const TableConstraints& constraints)
{
  std::uint64_t hash = 0;
  const auto addBits = [&hash](const auto& values)
  {
    for (const auto& value : values)
    {
      std::uint64_t bits = 0;
      static_assert(sizeof value == sizeof bits);
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 29;
    }
    hash = (hash ^ values.size()) * 0x9e3779b97f4a7c15U;
  };
  for (const ConstraintTable* const table : { &constraints.Lines, &constraints.Boundary })
  {
    addBits(table->XY);
    addBits(table->Height);
    addBits(table->Holes);
    for (const auto& edge : table->Edges)
    {
      addBits(edge);
    }
    hash += table->PolygonBegin;
  }
  return "constraints " + std::to_string(hash) +
    (constraints.Crossings == CrossingRule::Refuse ? " not crossing\n" : "\n");
}

namespace
{

constexpr std::int64_t NotFound = -1;

} // namespace

/// What the first pass finds: the constraints' vertices among the input's points.
struct ConstrainedPoints::Matching
{
  explicit Matching(TableConstraints constraints);

  std::size_t vertices() const { return this->Ids.size(); }
  /// Vertices of the tables' own; the others are named by ids of the input.
  std::size_t own() const { return this->Positions->points().size(); }
  Point2 position(std::size_t vertex) const
  {
    return vertex < this->own() ? this->Positions->points()[vertex]
                                : this->NamedPositions[vertex - this->own()];
  }
  std::size_t vertexOfId(std::int64_t id) const
  {
    return this->own() +
      std::size_t(
        std::lower_bound(this->Named.begin(), this->Named.end(), id) - this->Named.begin());
  }

  void take(const PointBlock& block, int threads);
  void setVertex(std::size_t vertex, const PointBlock& block, std::size_t i);
  std::vector<std::size_t> sorted() const;

  CrossingRule Crossings;
  std::vector<Point2> Holes;
  std::size_t PolygonBegin;           ///< edges from here to BoundaryBegin are those of polygons
  std::size_t BoundaryBegin;          ///< edges from here on are those of the boundary
  std::vector<std::int64_t> Named;    ///< ids of the input, ascending
  std::vector<Point2> NamedPositions; ///< of these
  std::vector<std::int64_t> Ids;      ///< of vertices in the stream
  std::vector<std::array<std::uint32_t, 2>> Edges; ///< of all constraints, by vertices
  std::vector<double> Heights;                     ///< of own vertices; NaN: not given
  std::vector<std::vector<double>> Values;         ///< of each column, of vertices that were found
  std::vector<std::uint32_t> Same; ///< at the end, of each vertex: the first at its position
  std::unique_ptr<PositionIndex> Positions; ///< of own vertices
  HullOfPoints Hull;                        ///< if there are holes
};

/// Gives the tables' memory back, step by step.
ConstrainedPoints::Matching::Matching(TableConstraints constraints)
  : Crossings(constraints.Crossings)
  , Holes(constraints.Lines.holes())
  , PolygonBegin(constraints.Lines.PolygonBegin)
  , BoundaryBegin(constraints.Lines.Edges.size())
{
  const std::array<ConstraintTable*, 2> tables{ &constraints.Lines, &constraints.Boundary };
  std::vector<Point2> positions;
  std::array<std::size_t, 2> first{}; // vertex of each table
  for (std::size_t t = 0; t < tables.size(); ++t)
  {
    ConstraintTable& table = *tables[t];
    first[t] = positions.size();
    for (std::size_t i = 0; 2 * i < table.XY.size(); ++i)
    {
      positions.push_back({ table.XY[2 * i], table.XY[2 * i + 1] });
    }
    table.Height.resize(table.XY.size() / 2, std::nan(""));
    this->Heights.insert(this->Heights.end(), table.Height.begin(), table.Height.end());
    for (const auto& edge : table.Edges)
    {
      if (table.XY.empty())
      {
        this->Named.insert(this->Named.end(), edge.begin(), edge.end());
      }
    }
    std::vector<double>().swap(table.Height);
  }
  const std::array<bool, 2> isNamed{ tables[0]->XY.empty(), tables[1]->XY.empty() };
  std::vector<double>().swap(tables[0]->XY);
  std::vector<double>().swap(tables[1]->XY);
  this->Positions = std::make_unique<PositionIndex>(std::move(positions));
  std::sort(this->Named.begin(), this->Named.end());
  this->Named.erase(std::unique(this->Named.begin(), this->Named.end()), this->Named.end());
  this->NamedPositions.assign(this->Named.size(), { std::nan(""), std::nan("") });
  this->Ids.assign(this->own() + this->Named.size(), std::int64_t(NotFound));
  if (this->vertices() > std::size_t(UINT32_MAX))
  {
    throw std::length_error("There are too many constraints; give fewer.");
  }
  this->Edges.reserve(tables[0]->Edges.size() + tables[1]->Edges.size());
  for (std::size_t t = 0; t < tables.size(); ++t)
  {
    const auto vertexOf = [&](std::int64_t id)
    { return std::uint32_t(isNamed[t] ? this->vertexOfId(id) : first[t] + std::size_t(id)); };
    for (const auto& edge : tables[t]->Edges)
    {
      this->Edges.push_back({ vertexOf(edge[0]), vertexOf(edge[1]) });
    }
    std::vector<std::array<std::int64_t, 2>>().swap(tables[t]->Edges);
  }
}

void ConstrainedPoints::Matching::setVertex(
  std::size_t vertex, const PointBlock& block, std::size_t i)
{
  this->Ids[vertex] = block.First + std::int64_t(i);
  if (vertex >= this->own())
  {
    this->NamedPositions[vertex - this->own()] = { block.XY[2 * i], block.XY[2 * i + 1] };
  }
  this->Values.resize(block.Columns.size());
  for (std::size_t c = 0; c < block.Columns.size(); ++c)
  {
    this->Values[c].resize(this->vertices(), std::nan(""));
    this->Values[c][vertex] = block.Columns[c][i];
  }
}

void ConstrainedPoints::Matching::take(const PointBlock& block, int threads)
{
  struct Found
  {
    std::size_t Point;
    std::size_t Vertex;
  };
  constexpr std::int64_t chunk = 8192;
  const auto count = std::int64_t(block.size());
  std::vector<std::vector<Found>> found(std::size_t((count + chunk - 1) / chunk));
  forChunks(count, chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      PointsView(block.XY.data(), block.size(), 2)
        .forBlocks(std::size_t(begin), std::size_t(end),
          [&](std::size_t first, const Point2* positions, std::size_t some)
          {
            this->Positions->findAll(positions, some,
              [&](std::size_t i, std::size_t vertex) {
                found[std::size_t(begin / chunk)].push_back({ first + i, vertex });
              });
          });
    });
  for (const std::vector<Found>& part : found)
  {
    for (const auto& [point, vertex] : part)
    {
      this->Ids[vertex] == NotFound ? this->setVertex(vertex, block, point) : void();
    }
  }
  for (std::size_t i = 0; !this->Holes.empty() && i < block.size(); ++i)
  {
    this->Hull.add({ block.XY[2 * i], block.XY[2 * i + 1] });
  }
  const auto end = block.First + count;
  for (auto named = std::lower_bound(this->Named.begin(), this->Named.end(), block.First);
       named != this->Named.end() && *named < end; ++named)
  {
    this->setVertex(this->vertexOfId(*named), block, std::size_t(*named - block.First));
  }
}

ConstrainedPoints::ConstrainedPoints(
  std::unique_ptr<PointStream> points, TableConstraints constraints, std::string name, int threads)
  : Input(std::move(points))
  , Name(std::move(name))
  , Threads(threadCount(threads))
  , Own(identityOf(constraints))
{
  this->Counts.Constraints =
    std::int64_t(constraints.Lines.Edges.size() + constraints.Boundary.Edges.size());
  this->First = std::make_unique<Matching>(std::move(constraints));
}

ConstrainedPoints::~ConstrainedPoints() = default;

std::string ConstrainedPoints::identity() const
{
  return this->Input->identity() + this->Own;
}

void ConstrainedPoints::rewind()
{
  this->Input->rewind();
  this->InputPoints = 0;
  this->IsInputRead = false;
  this->NextAdded = 0;
}

bool ConstrainedPoints::next(PointBlock& block, std::size_t most)
{
  if (!this->IsInputRead && this->Input->next(block, most))
  {
    this->InputPoints += std::int64_t(block.size());
    this->First ? this->First->take(block, this->Threads) : void();
    return true;
  }
  this->IsInputRead = true;
  if (this->First)
  {
    try
    {
      this->resolve();
    }
    catch (const std::invalid_argument& error)
    {
      throw IOError(this->Name, error.what());
    }
    this->First.reset();
    this->Report ? void(*this->Report = this->Counts) : void();
  }
  return this->nextAdded(block, most);
}

bool ConstrainedPoints::nextAdded(PointBlock& block, std::size_t most)
{
  const std::size_t count = std::min(most, this->Added.size() - this->NextAdded);
  const auto part = [&](const std::vector<double>& from, std::size_t width)
  {
    const auto begin = from.begin() + std::ptrdiff_t(width * this->NextAdded);
    return std::vector<double>(begin, begin + std::ptrdiff_t(width * count));
  };
  block.First = this->InputPoints + std::int64_t(this->NextAdded);
  block.XY = part(this->Added.XY, 2);
  block.Columns.clear();
  for (const std::vector<double>& column : this->Added.Columns)
  {
    block.Columns.push_back(part(column, 1));
  }
  this->NextAdded += count;
  return count > 0;
}

/// Appends the vertices that the input does not have, and gives all an id.
void ConstrainedPoints::addVertices()
{
  Matching& first = *this->First;
  const std::vector<std::string> names = this->columns();
  this->Added.Columns.assign(names.size(), {});
  first.Values.resize(names.size());
  for (std::vector<double>& values : first.Values)
  {
    values.resize(first.vertices(), std::nan(""));
  }
  first.Same.reserve(first.vertices());
  for (std::size_t v = 0; v < first.vertices(); ++v)
  {
    const bool isOwn = v < first.own();
    const std::int64_t found = isOwn ? first.Positions->find(first.position(v)) : NotFound;
    first.Same.push_back(std::uint32_t(found == NotFound ? v : std::size_t(found)));
    if (!isOwn && first.Ids[v] == NotFound)
    {
      throw std::invalid_argument("a constraint names point " +
        std::to_string(first.Named[v - first.own()]) + ", but there are " +
        std::to_string(this->InputPoints) + " points, counted from 0.");
    }
    if (first.Same[v] != v || first.Ids[v] != NotFound)
    {
      continue;
    }
    first.Ids[v] = this->InputPoints + std::int64_t(this->Added.size());
    const Point2 position = first.position(v);
    this->Added.XY.insert(this->Added.XY.end(), { position.x, position.y });
    for (std::size_t c = 0; c < names.size(); ++c)
    {
      const double given = isHeightColumn(names[c]) ? first.Heights[v] : std::nan("");
      first.Values[c][v] =
        std::isnan(given) && !this->Surface.empty() ? this->Surface.at(c).at(v) : given;
      this->Added.Columns[c].push_back(first.Values[c][v]);
    }
  }
}

/// The vertices with different ids, by these, as in memory.
std::vector<std::size_t> ConstrainedPoints::Matching::sorted() const
{
  std::vector<std::size_t> order;
  for (std::size_t v = 0; v < this->Same.size(); ++v)
  {
    this->Same[v] == v ? order.push_back(v) : void();
  }
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return this->Ids[a] < this->Ids[b]; });
  return order;
}

/// Splits the constraints where they cross, and appends the crossings. Sets positions to those of
/// the constraints' vertices, by the ids of the result. Leaves the matching empty.
ResolvedConstraints ConstrainedPoints::split(std::vector<Point2>& positions)
{
  Matching& first = *this->First;
  std::vector<PointId> ids;
  std::vector<std::uint32_t> rank(first.Same.size());
  std::vector<std::vector<double>> values(first.Values.size());
  for (const std::size_t v : first.sorted())
  {
    rank[v] = std::uint32_t(positions.size());
    positions.push_back(first.position(v));
    ids.push_back(first.Ids[v]);
    for (std::size_t c = 0; c < values.size(); ++c)
    {
      values[c].push_back(first.Values[c][v]);
    }
  }
  std::vector<Constraint> constraints;
  constraints.reserve(first.Edges.size());
  for (const auto& edge : first.Edges)
  {
    constraints.push_back({ rank[first.Same[edge[0]]], rank[first.Same[edge[1]]] });
  }
  std::vector<std::vector<double>>().swap(first.Values);
  first.Positions.reset();
  const PointsView view(positions.empty() ? nullptr : &positions.front().x, positions.size(), 2);
  ResolvedConstraints resolved =
    resolveCrossings(view, constraints, first.Crossings, this->Threads, ids);
  for (const CrossingPoint& crossing : resolved.Crossings)
  {
    positions.push_back(crossing.Position);
    this->Added.XY.insert(this->Added.XY.end(), { crossing.Position.x, crossing.Position.y });
    for (std::size_t c = 0; c < values.size(); ++c)
    {
      values[c].push_back((1 - crossing.Fraction) * values[c][std::size_t(crossing.A)] +
        crossing.Fraction * values[c][std::size_t(crossing.B)]);
      this->Added.Columns[c].push_back(values[c].back());
    }
  }
  return resolved;
}

void ConstrainedPoints::resolve()
{
  this->addVertices();
  std::vector<Point2> positions;
  const ResolvedConstraints resolved = this->split(positions);
  const Matching& first = *this->First;
  for (const ConstraintPiece& piece : resolved.Pieces)
  {
    const auto constraint = std::size_t(piece.Constraint);
    const SegmentRole role = constraint >= first.BoundaryBegin ? SegmentRole::Boundary
      : constraint >= first.PolygonBegin                       ? SegmentRole::Polygon
                                                               : SegmentRole::Line;
    this->Segments.push_back(
      { positions[std::size_t(piece.A)], positions[std::size_t(piece.B)], role });
  }
  const bool cuts = std::any_of(this->Segments.begin(), this->Segments.end(),
    [](const ConstraintSegment& segment) { return segment.Role != SegmentRole::Line; });
  if (cuts && resolved.NotFinite > 0)
  {
    throw std::invalid_argument(
      "it has polygons, and a point that is NaN or infinite; correct the point.");
  }
  this->Counts = { resolved, std::size_t(this->Counts.Constraints) };
  this->addHoles(positions);
}

/// Appends the edges around holes. Positions: the constraints' vertices.
void ConstrainedPoints::addHoles(const std::vector<Point2>& positions)
{
  const std::vector<Point2>& seeds = this->First->Holes;
  if (seeds.empty())
  {
    return;
  }
  HullOfPoints& hull = this->First->Hull;
  std::for_each(positions.begin(), positions.end(), [&hull](Point2 p) { hull.add(p); });
  std::vector<PositionPair> segments;
  for (const ConstraintSegment& segment : this->Segments)
  {
    segments.push_back({ segment.A, segment.B });
  }
  for (const auto& [a, b] : edgesAroundHoles(hull.corners(), segments, seeds, this->Threads))
  {
    this->Segments.push_back({ a, b, SegmentRole::Hole });
  }
}

std::vector<ConstraintSegment> ConstrainedPoints::takeSegments()
{
  return std::move(this->Segments);
}

void ConstrainedInput::describe(OutOfCoreOptions& options)
{
  if (this->Files.areGiven())
  {
    options.Constraints = [this] { return this->Joined->takeSegments(); };
  }
  else if (!this->Files.Holes.empty() || options.MarkConstraints)
  {
    throw IOError("Holes and marks of constraints need a file of constraints or of a boundary; "
                  "name one.");
  }
}

std::unique_ptr<PointStream> ConstrainedInput::join(std::unique_ptr<PointStream> points)
{
  if (!this->Files.areGiven())
  {
    return points;
  }
  auto joined = std::make_unique<ConstrainedPoints>(
    std::move(points), readConstraints(this->Files), this->Files.name(), this->Threads);
  joined->setReport(this->Counts);
  this->Joined = joined.get();
  return joined;
}

} // namespace tipp
