// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceSchedule.h"

#include "Predicates/CellBox.h"
#include "Triangulation/HullRepair.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

std::vector<PartitionIndex> partitionsWithPoints(const PiecePlan& plan, const SpilledPoints& points)
{
  std::vector<PartitionIndex> partitions;
  for (PartitionIndex p = 0; p < plan.Partitions.size(); ++p)
  {
    if (points.count(plan.PieceOf[std::size_t(p)]) > 0)
    {
      partitions.push_back(p);
    }
  }
  return partitions;
}

/// Assigning {} would keep the memory.
template <typename T>
void release(std::vector<T>& values)
{
  std::vector<T>().swap(values);
}

Box3 boxOf(const Box2& box)
{
  Box3 result;
  result.Min = { box.xmin, box.ymin, 0 };
  result.Max = { box.xmax, box.ymax, 0 };
  return result;
}

} // namespace

PieceSchedule::PieceSchedule(const PiecePlan& plan, const SpilledPoints& points,
  const PointRowLayout& rows, const std::vector<PartitionIndex>& unfinished)
  : Plan(plan)
  , Points(points)
  , Rows(rows)
  , Rim(plan.Partitions.size(), unfinished)
  , Waiting(this->Rim, unfinished, plan.PieceOf)
  , Pieces(std::size_t(plan.pieces()))
{
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    this->Pieces[std::size_t(piece)].Growing =
      GrowingPiece(points.starts()[std::size_t(piece)], points.count(piece));
  }
}

PieceSchedule::PieceSchedule(const PiecePlan& plan, const SpilledPoints& points,
  const PointRowLayout& rows, const SeamTriangles& initialMesh)
  : PieceSchedule(plan, points, rows, partitionsWithPoints(plan, points))
{
  this->takeFinal(this->Rim.add(SeamGrouping().group(initialMesh)));
}

std::vector<PartitionIndex> PieceSchedule::finishedPartitions(PartitionIndex piece) const
{
  std::vector<PartitionIndex> finished;
  const PartitionIndex end = this->Plan.FirstPartition[std::size_t(piece) + 1];
  for (PartitionIndex p = this->Plan.FirstPartition[std::size_t(piece)]; p < end; ++p)
  {
    if (this->isFinished(p))
    {
      finished.push_back(p);
    }
  }
  return finished;
}

bool PieceSchedule::addLoaded(PartitionIndex piece, int rank)
{
  State& state = this->Pieces[std::size_t(piece)];
  state.At = Stage::Loaded;
  state.Rank = rank;
  const PartitionIndex all = this->Plan.FirstPartition[std::size_t(piece) + 1] -
    this->Plan.FirstPartition[std::size_t(piece)];
  state.PartitionsLeft = all - PartitionIndex(this->finishedPartitions(piece).size());
  if (state.PartitionsLeft > 0)
  {
    this->Window.push_back(piece);
  }
  return state.PartitionsLeft == 0;
}

PartitionIndex PieceSchedule::activateNext(std::vector<PlainVertex>& vertices, int rank)
{
  for (const PartitionIndex piece : this->Window)
  {
    const PartitionIndex partition =
      this->rankOf(piece) == rank ? this->Waiting.activateNext(piece) : -1;
    if (partition >= 0)
    {
      this->Rim.gather(partition, vertices);
      return partition;
    }
  }
  return -1;
}

bool PieceSchedule::complete(PartitionResult result)
{
  const PartitionIndex piece = this->Plan.PieceOf[std::size_t(result.Partition)];
  this->Rim.finish(result.Partition);
  const GroupMesh::Final final = this->Rim.add(std::move(result.Seams));
  this->Waiting.deactivate(result.Partition);
  this->takeFinal(final);
  this->takeRowsFromAside();
  if (--this->Pieces[std::size_t(piece)].PartitionsLeft > 0)
  {
    return false;
  }
  this->Window.erase(std::find(this->Window.begin(), this->Window.end(), piece));
  return true;
}

PartitionIndex PieceSchedule::pieceOf(std::int64_t place) const
{
  const std::vector<std::int64_t>& starts = this->Points.starts();
  return static_cast<PartitionIndex>(
    std::upper_bound(starts.begin(), starts.end(), place) - starts.begin() - 1);
}

void PieceSchedule::takeFinal(const GroupMesh::Final& final)
{
  for (const std::uint32_t group : final.Indices)
  {
    const SeamGroups& groups = *final.Groups;
    const auto met = groups.met(group);
    const auto pieceAt = [&](PartitionIndex p) { return this->Plan.PieceOf[std::size_t(p)]; };
    const bool isInterior = !groups.Groups[group].HasArtificial && met.size() > 0 &&
      std::all_of(
        met.begin(), met.end(), [&](PartitionIndex p) { return pieceAt(p) == pieceAt(met[0]); });
    if (isInterior)
    {
      this->takeInterior(pieceAt(met[0]), groups, group);
    }
    else
    {
      this->takeBorder(groups, group);
    }
  }
}

void PieceSchedule::takeInterior(
  PartitionIndex piece, const SeamGroups& groups, std::uint32_t group)
{
  const std::int64_t first = this->Points.starts()[std::size_t(piece)];
  const auto vertices = groups.vertices(group);
  std::vector<std::array<std::int32_t, 3>>& seams = this->Pieces[std::size_t(piece)].Seams;
  for (const SeamGroups::Corners& corners : groups.triangles(group))
  {
    std::array<std::int32_t, 3> triangle = { std::int32_t(vertices[corners[0]].Id - first),
      std::int32_t(vertices[corners[1]].Id - first),
      std::int32_t(vertices[corners[2]].Id - first) };
    // Which corner comes first depends on the worker.
    std::rotate(
      triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    seams.push_back(triangle);
  }
}

void PieceSchedule::takeBorder(const SeamGroups& groups, std::uint32_t group)
{
  const auto vertices = groups.vertices(group);
  bool hasArtificial = false;
  for (const SeamGroups::Corners& corners : groups.triangles(group))
  {
    const std::array<PlainVertex, 3> triangle = { vertices[corners[0]], vertices[corners[1]],
      vertices[corners[2]] };
    const bool isHull =
      std::any_of(triangle.begin(), triangle.end(), [](const PlainVertex& v) { return v.Id < 0; });
    if (!isHull)
    {
      this->share(triangle);
      continue;
    }
    hasArtificial = true;
    for (const PlainVertex& v : triangle)
    {
      if (v.Id >= 0)
      {
        this->Hull.add(v);
        this->markRim(v);
      }
    }
  }
  for (const PartitionIndex p : groups.met(group))
  {
    State& state = this->Pieces[std::size_t(this->Plan.PieceOf[std::size_t(p)])];
    state.WaitsForHull = state.WaitsForHull || hasArtificial;
  }
}

void PieceSchedule::findMet(
  const std::array<PlainVertex, 3>& triangle, std::vector<std::int32_t>& met) const
{
  const Point2 a = triangle[0].Place;
  const Point2 b = triangle[1].Place;
  const Point2 c = triangle[2].Place;
  met.clear();
  this->Plan.Pieces.visitMet(Circumdisk(a, b, c),
    [&](PartitionIndex piece)
    {
      if (triangleMeetsBox(a, b, c, boxOf(this->Plan.Pieces.box(piece))))
      {
        met.push_back(std::int32_t(this->Plan.number(piece)));
      }
    });
  std::sort(met.begin(), met.end());
}

void PieceSchedule::share(const std::array<PlainVertex, 3>& triangle)
{
  this->findMet(triangle, this->Met);
  const auto owner = static_cast<PartitionIndex>(this->Plan.number(this->Met.front()));
  this->Met.erase(this->Met.begin());
  GrowingPiece& growing = this->Pieces[std::size_t(owner)].Growing;
  growing.addTriangle({ triangle[0].Id, triangle[1].Id, triangle[2].Id }, this->Met);
  for (const PlainVertex& v : triangle)
  {
    this->markRim(v);
    if (growing.needsRow(v.Id))
    {
      growing.addRow(v.Id, this->Rows);
      this->wantRow(owner, v.Id);
    }
  }
}

void PieceSchedule::markRim(const PlainVertex& v)
{
  if (v.Id < 0)
  {
    return;
  }
  const PartitionIndex piece = this->pieceOf(v.Id);
  State& state = this->Pieces[std::size_t(piece)];
  if (state.At > Stage::Loaded) // then it is marked already
  {
    return;
  }
  if (state.Rim.empty())
  {
    state.Rim.assign(std::size_t(this->Points.count(piece)), 0);
  }
  state.Rim[std::size_t(v.Id - this->Points.starts()[std::size_t(piece)])] = 1;
}

/// Its rows are where its points are loaded, perhaps on another rank, until its interior is
/// written: then those of the rim come here.
void PieceSchedule::wantRow(PartitionIndex by, std::int64_t place)
{
  State& state = this->Pieces[std::size_t(this->pieceOf(place))];
  if (state.Aside.Bytes > 0)
  {
    this->WantedFromAside.push_back({ by, place });
    ++this->Pieces[std::size_t(by)].RowsMissing;
    return;
  }
  if (state.At < Stage::Interior)
  {
    state.Wanted.push_back({ by, place });
    ++this->Pieces[std::size_t(by)].RowsMissing;
    return;
  }
  this->Pieces[std::size_t(by)].Growing.setRow(
    place, state.Growing.rimRow(place, this->Rows), this->Rows);
}

std::vector<std::int32_t> PieceSchedule::placesOfRim(const std::vector<std::uint8_t>& rim)
{
  std::vector<std::int32_t> places;
  for (std::size_t i = 0; i < rim.size(); ++i)
  {
    if (rim[i] != 0)
    {
      places.push_back(std::int32_t(i));
    }
  }
  return places;
}

InteriorTask PieceSchedule::startInterior(PartitionIndex piece)
{
  this->markLive(piece);
  State& state = this->Pieces[std::size_t(piece)];
  state.At = Stage::Writing;
  InteriorTask task;
  task.Piece = piece;
  task.Rim = PieceSchedule::placesOfRim(state.Rim);
  task.Seams = state.Seams;
  return task;
}

/// The points of triangles that are not final.
void PieceSchedule::markLive(PartitionIndex piece)
{
  const PartitionIndex begin = this->Plan.FirstPartition[std::size_t(piece)];
  const PartitionIndex end = this->Plan.FirstPartition[std::size_t(piece) + 1];
  this->Rim.visitVertices(begin, end,
    [&](const PlainVertex& v)
    {
      if (this->Pieces[std::size_t(piece)].Growing.owns(v.Id))
      {
        this->markRim(v);
      }
    });
}

void PieceSchedule::finishInterior(PartitionIndex piece, GrowingPiece interior)
{
  State& state = this->Pieces[std::size_t(piece)];
  state.At = Stage::Interior;
  state.Growing.takeInterior(std::move(interior));
  release(state.Rim);
  release(state.Seams);
  for (const WantedRow& row : state.Wanted)
  {
    State& by = this->Pieces[std::size_t(row.By)];
    by.Growing.setRow(row.Place, state.Growing.rimRow(row.Place, this->Rows), this->Rows);
    --by.RowsMissing;
  }
  release(state.Wanted);
}

bool PieceSchedule::allInterior() const
{
  return std::all_of(this->Pieces.begin(), this->Pieces.end(),
    [](const State& state) { return state.At >= Stage::Interior; });
}

PartitionIndex PieceSchedule::takeComplete()
{
  for (PartitionIndex piece = this->pieces() - 1; piece >= 0; --piece)
  {
    State& state = this->Pieces[std::size_t(piece)];
    if (state.At != Stage::Interior || state.RowsMissing > 0 || this->isMet(piece))
    {
      continue;
    }
    if (!state.WaitsForHull || this->HullRepaired)
    {
      state.At = Stage::Taken;
      return piece;
    }
    if (this->Aside && this->borderBytes() > this->MostBorderBytes)
    {
      this->writeAside(state);
    }
  }
  this->putAsideGrowing();
  return -1;
}

/// Borders that are not complete, where those that are do not suffice. What they get from then on
/// is kept beside it; so is what comes with the hull.
void PieceSchedule::putAsideGrowing()
{
  constexpr std::uint64_t timesMore = 5;
  std::uint64_t bytes = this->Aside ? this->borderBytes() : 0;
  for (State& state : this->Pieces)
  {
    if (bytes <= timesMore * this->MostBorderBytes)
    {
      return;
    }
    if (state.At == Stage::Interior && state.RowsMissing == 0)
    {
      bytes -= state.Growing.bytes();
      this->writeAside(state);
      bytes += state.Growing.bytes();
    }
  }
}

bool PieceSchedule::isMet(PartitionIndex piece) const
{
  const PartitionIndex end = this->Plan.FirstPartition[std::size_t(piece) + 1];
  PartitionIndex p = this->Plan.FirstPartition[std::size_t(piece)];
  while (p < end && !this->Rim.isMet(p))
  {
    ++p;
  }
  return p < end;
}

/// Unless it has been already.
void PieceSchedule::writeAside(State& state)
{
  if (state.Aside.Bytes > 0)
  {
    return;
  }
  SaveArchive archive;
  state.Growing.exchangeInterior(archive);
  state.Growing.exchangeBorder(archive);
  state.Aside = this->Aside->put(archive);
  state.Growing = state.Growing.emptied();
}

GrowingPiece PieceSchedule::border(PartitionIndex piece) const
{
  const State& state = this->Pieces[std::size_t(piece)];
  if (state.Aside.Bytes == 0)
  {
    return state.Growing;
  }
  const Bytes bytes = this->Aside->get(state.Aside);
  LoadArchive archive(bytes);
  GrowingPiece whole = state.Growing.emptied();
  whole.exchangeInterior(archive);
  whole.exchangeBorder(archive);
  whole.addBorder(state.Growing, this->Rows);
  return whole;
}

void PieceSchedule::finishBorder(PartitionIndex piece)
{
  State& state = this->Pieces[std::size_t(piece)];
  state.Growing = GrowingPiece();
  state.At = Stage::Done;
}

void PieceSchedule::repairHull()
{
  const std::vector<PlainVertex> hull = this->Hull.take();
  std::vector<Point2> points;
  points.reserve(hull.size());
  for (const PlainVertex& v : hull)
  {
    points.push_back(v.Place);
  }
  for (const std::array<std::uint32_t, 3>& corners :
    hullTriangles(std::move(points), this->Plan.Artificial))
  {
    this->share({ hull[corners[0]], hull[corners[1]], hull[corners[2]] });
  }
  this->takeRowsFromAside();
  this->HullRepaired = true;
}

/// One piece after the other.
void PieceSchedule::takeRowsFromAside()
{
  if (this->WantedFromAside.empty())
  {
    return;
  }
  std::sort(this->WantedFromAside.begin(), this->WantedFromAside.end(),
    [](const WantedRow& a, const WantedRow& b) { return a.Place < b.Place; });
  PartitionIndex from = -1;
  GrowingPiece whole;
  for (const WantedRow& row : this->WantedFromAside)
  {
    if (this->pieceOf(row.Place) != from)
    {
      from = this->pieceOf(row.Place);
      whole = this->border(from);
    }
    State& by = this->Pieces[std::size_t(row.By)];
    by.Growing.setRow(row.Place, whole.rimRow(row.Place, this->Rows), this->Rows);
    --by.RowsMissing;
  }
  release(this->WantedFromAside);
}

std::uint64_t PieceSchedule::borderBytes() const
{
  std::uint64_t bytes = 0;
  for (const State& state : this->Pieces)
  {
    bytes += state.Growing.bytes();
  }
  return bytes;
}

} // namespace tipp
