// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/ConstrainedStream.h"

#include "Files/Checksum.h"
#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{

std::string identityOf(const TableConstraints& constraints)
{
  Checksum sum;
  const auto add = [&sum](const auto& values)
  {
    const std::size_t count = values.size();
    sum.add(&count, sizeof count);
    sum.add(values.data(), values.size() * sizeof(values[0]));
  };
  for (const ConstraintTable* const table : { &constraints.Lines, &constraints.Boundary })
  {
    add(table->XY);
    add(table->Height);
    add(table->Holes);
    add(table->Edges);
    sum.add(&table->PolygonBegin, sizeof table->PolygonBegin);
  }
  return "constraints " + checksumText(sum.finish()) +
    (constraints.Crossings == CrossingRule::Refuse ? " not crossing\n" : "\n");
}

ConstrainedStream::ConstrainedStream(std::unique_ptr<PointStream> points,
  TableConstraints constraints, std::string name, int threads, std::unique_ptr<SegmentRows> lines)
  : Input(std::move(points))
  , Name(std::move(name))
  , Threads(threadCount(threads))
  , Crossings(constraints.Crossings)
  , Seeds(constraints.Lines.holes())
  , Given(std::move(constraints))
  , Lines(std::move(lines))
  , Own(identityOf(this->Given) + (this->Lines ? this->Lines->identity() : ""))
{
}

ConstrainedStream::~ConstrainedStream() = default;

std::string ConstrainedStream::identity() const
{
  return this->Input->identity() + this->Own;
}

void ConstrainedStream::begin(const std::string& files, std::uint64_t memory)
{
  this->Work = { files, memory, this->Threads };
  this->Stored =
    std::make_unique<StoredConstraints>(this->Work, std::exchange(this->Given, TableConstraints()),
      this->Lines.get(), StoredConstraints::Columns{ this->columns(), std::move(this->Surface) });
  this->Lines.reset();
}

void ConstrainedStream::rewind()
{
  this->Input->rewind();
  this->InputPoints = 0;
  this->IsInputRead = false;
  this->NextAdded = 0;
}

bool ConstrainedStream::next(PointBlock& block, std::size_t most)
{
  if (!this->IsInputRead && this->Input->next(block, most))
  {
    this->InputPoints += std::int64_t(block.size());
    if (!this->IsResolved)
    {
      this->Stored->add(block);
      const PointsView points(block.XY.data(), block.size(), 2);
      this->InputBounds.extend(surveyPoints(points, this->Threads).Bounds);
    }
    for (std::size_t i = 0; !this->IsResolved && !this->Seeds.empty() && i < block.size(); ++i)
    {
      this->Hull.add({ block.XY[2 * i], block.XY[2 * i + 1] });
    }
    return true;
  }
  this->IsInputRead = true;
  if (!this->IsResolved)
  {
    try
    {
      this->resolve(most);
    }
    catch (const std::invalid_argument& error)
    {
      throw IOError(this->Name, error.what());
    }
    this->IsResolved = true;
  }
  return this->nextAdded(block, most);
}

void ConstrainedStream::readAdded(std::int64_t first, std::size_t count, PointBlock& block) const
{
  const std::size_t words = 2 + this->columns().size();
  std::vector<double> rows(words * count);
  this->Added->read(first, count, rows.data());
  block.First = this->InputPoints + first;
  block.XY.clear();
  block.Columns.assign(words - 2, {});
  for (std::size_t i = 0; i < rows.size(); i += words)
  {
    block.XY.insert(block.XY.end(), { rows[i], rows[i + 1] });
    for (std::size_t c = 0; c < block.Columns.size(); ++c)
    {
      block.Columns[c].push_back(rows[i + 2 + c]);
    }
  }
}

bool ConstrainedStream::nextAdded(PointBlock& block, std::size_t most)
{
  const auto count = std::min(std::int64_t(most), this->Added->count() - this->NextAdded);
  this->readAdded(this->NextAdded, std::size_t(count), block);
  this->NextAdded += count;
  return count > 0;
}

PointBlock ConstrainedStream::added() const
{
  PointBlock all;
  this->readAdded(0, std::size_t(this->Added->count()), all);
  return all;
}

/// Writes the vertices that are not points of the input, and then the crossings.
void ConstrainedStream::addPoints()
{
  const std::size_t columns = this->columns().size();
  std::vector<double> row(2 + columns);
  this->Added = std::make_unique<RowFile>(this->Work.Files + ".added", row.size() * sizeof(double));
  this->Stored->forEachNew(
    [&](Point2 position, const double* values)
    {
      row[0] = position.x;
      row[1] = position.y;
      if (!this->Seeds.empty())
      {
        this->Hull.add(position);
      }
      std::copy(values, values + columns, row.begin() + 2);
      this->Added->append(row.data());
    });
  for (std::size_t i = 0; i < this->Split.Crossings.size(); ++i)
  {
    row[0] = this->Split.Crossings[i].x;
    row[1] = this->Split.Crossings[i].y;
    if (!this->Seeds.empty())
    {
      this->Hull.add(this->Split.Crossings[i]);
    }
    for (std::size_t c = 0; c < columns; ++c)
    {
      row[2 + c] = this->Split.Values[c][i];
    }
    this->Added->append(row.data());
  }
  this->Added->finish();
}

void ConstrainedStream::countSegments()
{
  const std::int64_t constraints = this->Stored->count();
  this->Counts.Constraints = constraints;
  this->forEach([this](const ConstraintSegment&) { ++this->Counts.Segments; });
  this->Stored->forEach([this](std::int64_t, Point2 a, Point2 b)
    { this->Counts.NotFinite += isFinite(a) && isFinite(b) ? 0 : 1; });
  this->Counts.Crossings = std::int64_t(this->Split.Crossings.size());
  this->Counts.Rounds = this->Split.Rounds;
  // Edges of polygons come last. A polygon with a missing edge has no inside.
  const bool hasPolygons =
    constraints > 0 && this->Stored->roleOf(constraints - 1) != SegmentRole::Line;
  if (hasPolygons && this->Counts.NotFinite > 0)
  {
    throw std::invalid_argument(
      "it has polygons, and a point that is NaN or infinite; correct the point.");
  }
}

/// Visits the points of the input again, and then the vertices that are not among them.
void ConstrainedStream::forEachBlock(
  std::size_t most, const std::function<void(const PointBlock&)>& visit) const
{
  PointBlock block;
  for (this->Input->rewind(); this->Input->next(block, most);)
  {
    visit(block);
  }
  const std::size_t columns = this->columns().size();
  const auto restart = [&](std::int64_t first)
  {
    block.First = first;
    block.XY.clear();
    block.Columns.assign(columns, {});
  };
  restart(this->InputPoints);
  this->Stored->forEachNew(
    [&](Point2 position, const double* values)
    {
      block.XY.insert(block.XY.end(), { position.x, position.y });
      for (std::size_t c = 0; c < columns; ++c)
      {
        block.Columns[c].push_back(values[c]);
      }
      if (block.size() == most)
      {
        visit(block);
        restart(block.First + std::int64_t(most));
      }
    });
  visit(block);
}

void ConstrainedStream::resolve(std::size_t blockPoints)
{
  this->Stored->match();
  this->Split = splitStored(
    *this->Stored,
    [&](const std::function<void(const PointBlock&)>& visit)
    { this->forEachBlock(blockPoints, visit); },
    this->Crossings, this->columns().size(), this->Work);
  this->addPoints();
  this->countSegments();
  this->addHoles();
}

void ConstrainedStream::addHoles()
{
  if (this->Seeds.empty())
  {
    return;
  }
  std::vector<PositionPair> segments;
  this->forEach(
    [&segments](const ConstraintSegment& segment) {
      segments.push_back({ segment.A, segment.B });
    });
  this->HoleEdges = edgesAroundHoles(this->Hull.corners(), segments, this->Seeds, this->Threads);
}

std::int64_t ConstrainedStream::count() const
{
  return this->Counts.Segments + std::int64_t(this->HoleEdges.size());
}

void ConstrainedStream::forEach(const VisitSegment& visit) const
{
  auto part = this->Split.Parts.begin();
  this->Stored->forEach(
    [&](std::int64_t number, Point2 a, Point2 b)
    {
      const SegmentRole role = this->Stored->roleOf(number);
      if (part != this->Split.Parts.end() && part->Number == number)
      {
        for (; part != this->Split.Parts.end() && part->Number == number; ++part)
        {
          visit({ part->A, part->B, role });
        }
      }
      else if (isFinite(a) && isFinite(b) && !(a == b))
      {
        visit({ a, b, role });
      }
    });
  for (const auto& [a, b] : this->HoleEdges)
  {
    visit({ a, b, SegmentRole::Hole });
  }
}

/// The indices of segments that others cover in part, ascending, and the end of that part.
std::vector<std::pair<std::int64_t, Point2>> ConstrainedStream::findCovered() const
{
  const auto forEachItem = [this](const SegmentTiles::Visit& visit)
  {
    std::int64_t index = 0;
    this->forEach(
      [&](const ConstraintSegment& segment)
      {
        // A hole's outline is no edge of the triangulation.
        if (segment.Role != SegmentRole::Hole)
        {
          visit({ segment.A, segment.B, index });
        }
        ++index;
      });
  };
  const SegmentTiles tiles(this->Work.Files, forEachItem,
    SegmentTiles::tilesFor(this->count(), this->Work.Memory), this->Threads);
  std::vector<std::pair<std::int64_t, Point2>> covered;
  tiles.findCovered(
    [&covered](std::int64_t segment, Point2 end) { covered.emplace_back(segment, end); });
  std::sort(
    covered.begin(), covered.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return covered;
}

void ConstrainedStream::forEachUncovered(const VisitSegment& visit) const
{
  const std::vector<std::pair<std::int64_t, Point2>> all = this->findCovered();
  std::int64_t index = 0;
  auto covered = all.begin();
  this->forEach(
    [&](const ConstraintSegment& segment)
    {
      const bool isCovered = covered != all.end() && covered->first == index;
      ++index;
      const Point2 end = isCovered ? (covered++)->second : segment.A;
      if (!isCovered || segment.Role != SegmentRole::Line) // others also decide what is inside
      {
        visit(segment);
        return;
      }
      const Point2 high = lexicographicLess(segment.A, segment.B) ? segment.B : segment.A;
      if (!(end == high))
      {
        visit({ end, high, segment.Role });
      }
    });
}

void ConstrainedStream::end()
{
  this->Stored.reset();
  this->Split = {};
  std::vector<PositionPair>().swap(this->HoleEdges);
}

std::unique_ptr<ConstrainedStream> joinConstraints(
  std::unique_ptr<PointStream> points, const ConstraintFiles& files, int threads)
{
  ConstraintFiles tables = files;
  std::unique_ptr<SegmentRows> lines;
  if (SegmentRows::isFor(tables.Lines))
  {
    lines = std::make_unique<SegmentRows>(tables.Lines, tables.Wrap);
    tables.Lines.clear();
  }
  return std::make_unique<ConstrainedStream>(
    std::move(points), readConstraints(tables), files.name(), threads, std::move(lines));
}

std::unique_ptr<PointStream> joinConstraints(
  std::unique_ptr<PointStream> points, const ConstraintFiles& files, bool areMarked, int threads)
{
  if (files.areGiven())
  {
    return joinConstraints(std::move(points), files, threads);
  }
  if (!files.Holes.empty() || areMarked)
  {
    throw IOError("Holes and marks of constraints need a file of constraints or of a boundary; "
                  "name one.");
  }
  return points;
}

} // namespace tipp
