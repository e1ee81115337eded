// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceSchedule.h"

#include "Predicates/CellBox.h"
#include "Triangulation/HullRepair.h"

#include <algorithm>
#include <stdexcept>

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

bool PieceSchedule::addLoaded(PartitionIndex piece, std::unique_ptr<LoadedPiece> loaded)
{
  State& state = this->Pieces[std::size_t(piece)];
  state.Loaded = std::move(loaded);
  state.At = Stage::Loaded;
  state.Loaded->Seams = std::move(state.SavedSeams);
  for (const std::int32_t point : state.SavedRim)
  {
    state.Loaded->Rim[std::size_t(point)] = 1;
  }
  state.SavedRim = {};
  state.WasLoaded = false;
  const PartitionIndex begin = this->Plan.FirstPartition[std::size_t(piece)];
  const PartitionIndex end = this->Plan.FirstPartition[std::size_t(piece) + 1];
  state.Loaded->PartitionsLeft = 0;
  for (PartitionIndex p = begin; p < end; ++p)
  {
    state.Loaded->PartitionsLeft += this->isFinished(p) ? 0 : 1;
  }
  if (state.Loaded->PartitionsLeft > 0)
  {
    this->Window.push_back(piece);
  }
  return state.Loaded->PartitionsLeft == 0;
}

PartitionIndex PieceSchedule::activateNext(std::vector<PlainVertex>& vertices)
{
  for (const PartitionIndex piece : this->Window)
  {
    const PartitionIndex partition = this->Waiting.activateNext(piece);
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
  const PartitionIndex partition = result.Partition;
  const PartitionIndex piece = this->Plan.PieceOf[std::size_t(partition)];
  this->Rim.finish(partition);
  const GroupMesh::Final final = this->Rim.add(std::move(result.Seams));
  this->Waiting.deactivate(partition);
  this->takeFinal(final);
  LoadedPiece& loaded = this->loaded(piece);
  loaded.InteriorCounts[std::size_t(partition - this->Plan.FirstPartition[std::size_t(piece)])] =
    result.InteriorCount;
  const std::int64_t first = this->Points.starts()[std::size_t(piece)];
  for (const Duplicate& duplicate : result.Duplicates)
  {
    loaded.Representatives.emplace(
      std::int32_t(duplicate.Point - first), std::int32_t(duplicate.Representative - first));
  }
  if (--loaded.PartitionsLeft > 0)
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
  std::vector<std::array<std::int32_t, 3>>& seams = this->loaded(piece).Seams;
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
    SeamTriangle seam{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      seam[i] = { triangle[i].Place, triangle[i].Id, 0 };
      this->markRim(triangle[i]);
    }
    this->Hull.push_back(seam);
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
      growing.addRow(v.Id, this->rowOf(v.Id), this->Rows);
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
  const State& state = this->Pieces[std::size_t(piece)];
  if (state.Loaded)
  {
    std::uint8_t& mark =
      state.Loaded->Rim[std::size_t(v.Id - this->Points.starts()[std::size_t(piece)])];
    if (mark == 0) // a piece that is being written is only read
    {
      mark = 1;
    }
  }
}

const double* PieceSchedule::rowOf(std::int64_t place) const
{
  const PartitionIndex piece = this->pieceOf(place);
  const State& state = this->Pieces[std::size_t(piece)];
  return state.Loaded ? state.Loaded->Rows.data() +
      std::size_t(place - this->Points.starts()[std::size_t(piece)]) * this->Rows.Words
                      : state.Growing.rimRow(place, this->Rows);
}

void PieceSchedule::findRim(PartitionIndex piece)
{
  this->Pieces[std::size_t(piece)].IsWritten = true; // from here on
  const PartitionIndex begin = this->Plan.FirstPartition[std::size_t(piece)];
  const PartitionIndex end = this->Plan.FirstPartition[std::size_t(piece) + 1];
  this->Rim.visitLive(
    [&](const SeamGroups& groups, std::uint32_t group)
    {
      const auto met = groups.met(group);
      if (std::none_of(
            met.begin(), met.end(), [&](PartitionIndex p) { return begin <= p && p < end; }))
      {
        return;
      }
      for (const PlainVertex& v : groups.vertices(group))
      {
        if (this->Pieces[std::size_t(piece)].Growing.owns(v.Id))
        {
          this->markRim(v);
        }
      }
    });
}

void PieceSchedule::finishInterior(PartitionIndex piece)
{
  State& state = this->Pieces[std::size_t(piece)];
  state.Loaded.reset();
  state.IsWritten = false;
  state.At = Stage::Interior;
}

PartitionIndex PieceSchedule::takeComplete()
{
  for (PartitionIndex piece = this->pieces() - 1; piece >= 0; --piece)
  {
    State& state = this->Pieces[std::size_t(piece)];
    if (state.At != Stage::Interior || (state.WaitsForHull && !this->HullRepaired))
    {
      continue;
    }
    const PartitionIndex begin = this->Plan.FirstPartition[std::size_t(piece)];
    const PartitionIndex end = this->Plan.FirstPartition[std::size_t(piece) + 1];
    PartitionIndex p = begin;
    while (p < end && !this->Rim.isMet(p))
    {
      ++p;
    }
    if (p == end)
    {
      state.At = Stage::Taken;
      state.IsWritten = true;
      return piece;
    }
  }
  return -1;
}

void PieceSchedule::finishBorder(PartitionIndex piece)
{
  State& state = this->Pieces[std::size_t(piece)];
  state.Growing = GrowingPiece();
  state.IsWritten = false;
  state.At = Stage::Done;
}

void PieceSchedule::repairHull()
{
  removeArtificialPoints(this->Hull, this->Plan.Artificial);
  for (const SeamTriangle& triangle : this->Hull)
  {
    std::array<PlainVertex, 3> plain{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      plain[i] = { triangle[i].Place, triangle[i].Id };
    }
    this->share(plain);
  }
  this->Hull = {};
  this->HullRepaired = true;
}

std::uint64_t PieceSchedule::borderBytes()
{
  std::uint64_t bytes = 0;
  for (State& state : this->Pieces)
  {
    state.BorderBytes = state.IsWritten ? state.BorderBytes : state.Growing.bytes();
    bytes += state.BorderBytes;
  }
  return bytes;
}

} // namespace tipp
