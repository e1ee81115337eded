// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/BorrowedByReference.h"

#include "Partitioned/IdMap.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace tipp
{

BorrowedByReference::BorrowedByReference(const PartitionedMesh& mesh, const PieceFile& piece,
  const std::int64_t* ownIds, ReadCounters& counters)
  : Mesh(mesh)
  , Own(piece)
  , Counters(counters)
{
  this->addRuns(mesh, piece, true);
  this->addRuns(mesh, piece, false);
  if (this->BorrowedCells != piece.summary().BorrowedCells)
  {
    piece.fail("borrows another number of cells than the index says");
  }
  this->matchPoints(this->readIds(PieceRole::PointIds, true), ownIds);

  this->CellIds = this->readIds(PieceRole::CellIds, false);
  this->CellOrder.resize(this->CellIds.size());
  std::iota(this->CellOrder.begin(), this->CellOrder.end(), std::int64_t(0));
  std::sort(this->CellOrder.begin(), this->CellOrder.end(),
    [this](std::int64_t a, std::int64_t b)
    { return this->CellIds[std::size_t(a)] < this->CellIds[std::size_t(b)]; });
  this->CellPlaces.resize(this->CellOrder.size());
  for (std::size_t i = 0; i < this->CellOrder.size(); ++i)
  {
    this->CellPlaces[std::size_t(this->CellOrder[i])] = piece.summary().Cells + std::int64_t(i);
  }
}

BorrowedByReference::Source& BorrowedByReference::sourceOf(
  const PartitionedMesh& mesh, std::int32_t owner)
{
  const PieceSummary* const summary = &mesh.Pieces[std::size_t(owner)];
  const auto found = std::find_if(this->Sources.begin(), this->Sources.end(),
    [summary](const Source& source) { return &source.File->summary() == summary; });
  if (found != this->Sources.end())
  {
    return *found;
  }
  this->Files.emplace_back(mesh, std::size_t(owner), this->Counters);
  this->Sources.push_back({ &this->Files.back(), {}, {} });
  return this->Sources.back();
}

void BorrowedByReference::addRuns(
  const PartitionedMesh& mesh, const PieceFile& piece, bool ofPoints)
{
  const PieceTable& own = piece.table();
  for (const BorrowedGroup& group : ofPoints ? own.BorrowedPoints : own.BorrowedCells)
  {
    Source& source = this->sourceOf(mesh, group.Owner);
    const PieceTable& table = source.File->table();
    const std::size_t groups = (ofPoints ? table.PointGroups : table.CellGroups).size();
    if (std::size_t(group.Group) >= groups)
    {
      piece.fail(
        "borrows a group that its owner, piece " + std::to_string(group.Owner) + ", does not lend");
    }
    const std::size_t part = std::size_t(group.Group) + 1;
    const std::vector<std::int64_t>& starts = source.File->partStarts(ofPoints);
    std::int64_t& count = ofPoints ? this->Candidates : this->BorrowedCells;
    const Run run{ starts[part], count, starts[part + 1] - starts[part], part };
    (ofPoints ? source.PointRuns : source.CellRuns).push_back(run);
    count += run.Count;
  }
}

std::vector<std::int64_t> BorrowedByReference::readIds(PieceRole role, bool ofPoints) const
{
  std::vector<std::int64_t> ids(std::size_t(ofPoints ? this->Candidates : this->BorrowedCells));
  for (const Source& source : this->Sources)
  {
    for (const Run& run : ofPoints ? source.PointRuns : source.CellRuns)
    {
      source.File->read(
        source.File->find(role), run.Part, run.Part + 1, ids.data() + std::size_t(run.First));
      source.File->requireIds(ids.data() + std::size_t(run.First), std::size_t(run.Count),
        ofPoints ? this->Mesh.Points : this->Mesh.Cells);
    }
  }
  return ids;
}

void BorrowedByReference::matchPoints(
  const std::vector<std::int64_t>& ids, const std::int64_t* ownIds)
{
  std::vector<std::int64_t> distinct = ids;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  const IdMap borrowed(distinct.data(), nullptr, distinct.size());
  // The index of each distinct point in the piece: among its own points, or after them.
  std::vector<std::int64_t> places(distinct.size(), -1);
  const std::int64_t own = this->Own.summary().Points;
  for (std::int64_t i = 0; i < own; ++i)
  {
    const std::int64_t found = borrowed.find(ownIds[i]);
    if (found >= 0)
    {
      places[std::size_t(found)] = i;
    }
  }
  for (std::size_t i = 0; i < distinct.size(); ++i)
  {
    if (places[i] < 0)
    {
      places[i] = own + std::int64_t(this->NewPoints.size());
      this->NewPoints.push_back(distinct[i]);
    }
  }
  this->PointPlaces.resize(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    this->PointPlaces[i] = places[std::size_t(borrowed.find(ids[i]))];
  }
}

std::vector<std::size_t> BorrowedByReference::arraysOf(PieceRole role) const
{
  std::vector<std::size_t> arrays;
  for (const Source& source : this->Sources)
  {
    arrays.push_back(source.File->find(role));
  }
  return arrays;
}

std::vector<std::size_t> BorrowedByReference::arraysOf(const StoredArray& attribute) const
{
  std::size_t number = 0;
  while (this->Mesh.Arrays[number].Name != attribute.Name ||
    this->Mesh.Arrays[number].OfPoints != attribute.OfPoints ||
    this->Mesh.Arrays[number].Step != attribute.Step)
  {
    ++number;
  }
  std::vector<std::size_t> arrays;
  for (const Source& source : this->Sources)
  {
    arrays.push_back(source.File->findAttribute(number));
  }
  return arrays;
}

void BorrowedByReference::copyTuples(bool ofPoints, const std::vector<std::int64_t>& places,
  const std::vector<std::size_t>& arrays, char* to) const
{
  std::vector<char> tuples;
  for (std::size_t s = 0; s < this->Sources.size(); ++s)
  {
    const Source& source = this->Sources[s];
    const std::size_t bytes = source.File->arrays()[arrays[s]].tupleBytes();
    for (const Run& run : ofPoints ? source.PointRuns : source.CellRuns)
    {
      tuples.resize(std::size_t(run.Count) * bytes);
      source.File->read(arrays[s], run.Part, run.Part + 1, tuples.data());
      for (std::size_t i = 0; i < std::size_t(run.Count); ++i)
      {
        const std::size_t place = std::size_t(places[std::size_t(run.First) + i]);
        std::memcpy(to + place * bytes, tuples.data() + i * bytes, bytes);
      }
    }
  }
}

template <typename Id>
void BorrowedByReference::addCells(const Source& source, const Run& run, Piece& piece) const
{
  const std::size_t corners = std::size_t(piece.CellSize);
  std::vector<Id> ids(std::size_t(run.Count) * corners);
  source.File->read(source.File->find(PieceRole::Connectivity), run.Part, run.Part + 1, ids.data());
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const std::int64_t inOwner = ids[i];
    const auto after = std::upper_bound(source.PointRuns.begin(), source.PointRuns.end(), inOwner,
      [](std::int64_t point, const Run& points) { return point < points.InOwner; });
    if (after == source.PointRuns.begin() || inOwner - (after - 1)->InOwner >= (after - 1)->Count)
    {
      source.File->fail("lends cells without their points");
    }
    const Run& points = *(after - 1);
    const std::int64_t place =
      this->PointPlaces[std::size_t(points.First + inOwner - points.InOwner)];
    const std::size_t cell = std::size_t(this->CellPlaces[std::size_t(run.First) + i / corners]);
    if (piece.WideIds)
    {
      piece.Connectivity.as<std::int64_t>()[cell * corners + i % corners] = place;
    }
    else
    {
      piece.Connectivity.as<std::int32_t>()[cell * corners + i % corners] = std::int32_t(place);
    }
  }
}

void BorrowedByReference::fill(Piece& piece) const
{
  const std::size_t own = std::size_t(piece.OwnedPoints);
  std::copy(
    this->NewPoints.begin(), this->NewPoints.end(), piece.PointIds.as<std::int64_t>() + own);
  std::memset(piece.PointGhosts.data() + own, 1, this->NewPoints.size());
  this->copyTuples(
    true, this->PointPlaces, this->arraysOf(PieceRole::Points), piece.Coordinates.data());
  for (std::size_t i = 0; i < this->CellIds.size(); ++i)
  {
    piece.CellIds.as<std::int64_t>()[this->CellPlaces[i]] = this->CellIds[i];
  }
  for (const Source& source : this->Sources)
  {
    const bool wide = hasWideIds(this->Mesh, source.File->summary());
    for (const Run& run : source.CellRuns)
    {
      wide ? this->addCells<std::int64_t>(source, run, piece)
           : this->addCells<std::int32_t>(source, run, piece);
    }
  }
  for (Piece::Attribute& attribute : piece.Attributes)
  {
    const bool ofPoints = attribute.Description.OfPoints;
    this->copyTuples(ofPoints, ofPoints ? this->PointPlaces : this->CellPlaces,
      this->arraysOf(attribute.Description), attribute.Values.data());
  }
}

} // namespace tipp
