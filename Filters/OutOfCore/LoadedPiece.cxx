// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/LoadedPiece.h"

#include "OutOfCore/FinishPieces.h"
#include "Partitioned/GrowingPiece.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

/// Returns whether a worker should keep its memory for the next partition. If most vertices belong
/// to other partitions, partitioning does not pay, and hardly any two partitions are triangulated
/// at the same time.
bool isWorthKeeping(std::size_t vertices, std::size_t points)
{
  constexpr std::size_t some = 16384;
  return vertices <= 2 * points + some;
}

} // namespace

/// Sorts the final boundary triangles of one partition into those of the piece's interior and those
/// at borders.
struct LoadedPiece::FinalTriangleSorter : public FinalTriangleConsumer
{
  FinalTriangleSorter(const LoadedPiece& piece, const LowestPoints& lowest)
    : Loaded(piece)
    , Lowest(lowest)
    , Sorter(piece.Work.Plan, this->Borders, piece.Work.longestAtBorder())
  {
  }

  void add(const BoundaryTriangle& triangle) override
  {
    BoundaryTriangle renamed = triangle;
    for (BoundaryVertex& v : renamed)
    {
      v.Id = this->Lowest.renamed(v.Id);
    }
    const bool isHull = takeHullVertices(renamed, this->HullVertices);
    if (!isHull && this->isInterior(renamed))
    {
      this->addBoundary(renamed);
      return;
    }
    std::copy_if(renamed.begin(), renamed.end(), std::back_inserter(this->InterfaceVertices),
      [this](const BoundaryVertex& v) { return this->Loaded.owns(v); });
    if (!isHull)
    {
      this->Sorter.add(renamed);
    }
  }

  std::vector<std::array<std::int32_t, 3>> BoundaryTriangles;
  std::vector<BoundaryVertex> InterfaceVertices;
  std::vector<BoundaryVertex> HullVertices;
  BordersByOwner Borders;

private:
  bool isInterior(const BoundaryTriangle& triangle) const
  {
    bool isInterior = true;
    this->Loaded.Work.Plan.Pieces.visitMet(
      Circumdisk(triangle[0].Position, triangle[1].Position, triangle[2].Position),
      [&](PartitionIndex piece)
      {
        isInterior =
          isInterior && (piece == this->Loaded.Piece || this->Loaded.Work.Points.count(piece) == 0);
      });
    return isInterior;
  }

  void addBoundary(const BoundaryTriangle& triangle)
  {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      corners[i] = std::int32_t(triangle[i].Id - this->Loaded.First);
    }
    // The worker does not determine which corner is first, so put the lowest one first.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    this->BoundaryTriangles.push_back(corners);
  }

  const LoadedPiece& Loaded;
  const LowestPoints& Lowest;
  BorderSorter Sorter;
};

LoadedPiece::LoadedPiece(const PieceWork& work, PartitionIndex piece)
  : Work(work)
  , Piece(piece)
  , First(work.Points.first(piece))
  , Rows(std::size_t(work.Points.count(piece)) * work.Rows.Words)
  , IsOnInterface(std::size_t(work.Points.count(piece)), 0)
{
  work.Points.read(piece, this->Rows.data());
  const Tiling& inner = work.Plan.Inner[std::size_t(piece)];
  this->Buckets = bucketPoints<std::int32_t>(this->points().scaled(work.Factor), inner, 1);
  this->InteriorCounts.assign(std::size_t(inner.size()), 0);
  if (work.Constraints && work.Constraints->count(piece) > 0)
  {
    this->Constraints = std::make_unique<LoadedSegments>(
      work.Constraints->read(piece), this->points(), work.Factor, inner);
  }
}

PointsView LoadedPiece::points() const
{
  return { this->Rows.data(), this->IsOnInterface.size(), this->Work.Rows.Words };
}

std::uint64_t LoadedPiece::bytesOf(const PieceWork& work, PartitionIndex piece)
{
  return MemoryPlan::pieceBytes(work.Points.count(piece), work.Rows.Words) +
    (work.Constraints ? work.Constraints->bytesOf(piece) : 0);
}

bool LoadedPiece::owns(const BoundaryVertex& v) const
{
  return v.Id >= this->First && v.Id < this->First + std::int64_t(this->IsOnInterface.size());
}

/// Provides a worker for the piece's partitions.
void LoadedPiece::prepare(Workspace& space)
{
  if (space.Piece == this->Piece && space.Triangulator)
  {
    return;
  }
  const PiecePlan& plan = this->Work.Plan;
  space.Triangulator.reset(); // before the next one is made, which reuses the kernel
  space.Triangulator = std::make_unique<Worker<std::int32_t>>(
    plan.Partitions, this->Buckets, this->First, -plan.FirstPartition[std::size_t(this->Piece)]);
  if (this->Constraints)
  {
    space.Triangulator->setEditor(this->Constraints->makeEditor());
  }
  space.Piece = this->Piece;
  if (!space.Router)
  {
    space.Router =
      std::make_unique<Routing<std::int32_t>>(space.Order.partitions(), space.Order.regions());
  }
}

SentMessages LoadedPiece::triangulate(
  Workspace& space, PartitionIndex partition, const std::vector<VertexMessage>& inbox)
{
  this->prepare(space);
  Worker<std::int32_t>& worker = *space.Triangulator;
  Routing<std::int32_t>& routing = *space.Router;
  routing.triangulate(worker, partition, inbox);

  std::vector<Duplicate> duplicates = worker.duplicates();
  const LowestPoints lowest(duplicates);
  FinalTriangleSorter sorter(*this, lowest);
  SentMessages sent = routing.send(worker, sorter);
  for (auto& [to, message] : sent)
  {
    for (BoundaryVertex& v : message.Vertices)
    {
      v.Id = lowest.renamed(v.Id);
    }
  }

  const PartitionIndex inPiece =
    partition - this->Work.Plan.FirstPartition[std::size_t(this->Piece)];
  const std::size_t triangles = worker.interiorCount();
  this->InteriorCounts[std::size_t(inPiece)] = triangles;
  std::int32_t* const corners = this->Buckets.triangles(inPiece);
  for (std::size_t i = 0; !lowest.isEmpty() && i < 3 * triangles; ++i)
  {
    corners[i] = std::int32_t(lowest.renamed(this->First + corners[i]) - this->First);
  }
  const std::size_t vertices = worker.vertexCount();
  if (!isWorthKeeping(vertices, this->Buckets.count(inPiece)))
  {
    space.clear();
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->take(sorter, sent);
  this->take(duplicates);
  this->Result.Figures.WorkerVertices += std::int64_t(vertices);
  return sent;
}

void LoadedPiece::take(FinalTriangleSorter& sorter, const SentMessages& sent)
{
  this->BoundaryTriangles.insert(this->BoundaryTriangles.end(), sorter.BoundaryTriangles.begin(),
    sorter.BoundaryTriangles.end());
  for (const BoundaryVertex& v : sorter.InterfaceVertices)
  {
    this->markInterface(v);
  }
  this->Result.HullVertices.insert(
    this->Result.HullVertices.end(), sorter.HullVertices.begin(), sorter.HullVertices.end());
  append(std::move(sorter.Borders), this->Result.Borders);
  for (const auto& [to, message] : sent)
  {
    const PartitionIndex piece = this->Work.Plan.PieceOf[std::size_t(to)];
    if (piece == this->Piece)
    {
      continue;
    }
    for (const BoundaryVertex& v : message.Vertices)
    {
      this->markInterface(v);
    }
    this->Result.Figures.BoundaryBytes += message.Vertices.size() * sizeof(BoundaryVertex);
    this->Result.Sent[piece].emplace_back(to, message);
  }
}

void LoadedPiece::take(const std::vector<Duplicate>& duplicates)
{
  for (const Duplicate& duplicate : duplicates)
  {
    this->Representatives.emplace(std::int32_t(duplicate.Point - this->First),
      std::int32_t(duplicate.Representative - this->First));
  }
  this->Result.Figures.Duplicates += std::int64_t(duplicates.size());
}

void LoadedPiece::markInterface(const BoundaryVertex& v)
{
  if (this->owns(v))
  {
    this->IsOnInterface[std::size_t(v.Id - this->First)] = 1;
  }
}

/// Calls filter(corners, count, bucket) for the triangles of each partition, and with NoPartition
/// for the interior triangles between partitions. filter() removes triangles and returns how many
/// are left.
template <typename Filter>
void LoadedPiece::filterTriangles(const Filter& filter)
{
  for (PartitionIndex p = 0; p < this->Buckets.partitions(); ++p)
  {
    std::size_t& count = this->InteriorCounts[std::size_t(p)];
    count = filter(this->Buckets.triangles(p), count, p);
  }
  if (!this->BoundaryTriangles.empty())
  {
    this->BoundaryTriangles.resize(
      filter(this->BoundaryTriangles.front().data(), this->BoundaryTriangles.size(), NoPartition));
  }
}

/// Inserts the remaining constraints that are complete in the interior. The triangles that the
/// others cross go to Result.Crossed, and leave the interior.
void LoadedPiece::constrain()
{
  CrossedPart crossed;
  this->Constraints->finishInserting(this->Representatives);
  this->filterTriangles([&](std::int32_t* corners, std::size_t count, PartitionIndex bucket)
    { return this->Constraints->takeCrossed(bucket, this->First, corners, count, crossed); });
  this->Constraints->addEdgesAndTouches(this->First, crossed);
  this->Result.Crossed = splitIncomplete(crossed,
    [this](std::int64_t point) { return !this->IsOnInterface[std::size_t(point - this->First)]; });
  for (const CrossedPart::Corners& triangle : this->Result.Crossed.Triangles)
  {
    for (const std::int64_t point : triangle)
    {
      this->IsOnInterface[std::size_t(point - this->First)] = 1;
    }
  }
  retriangulate(crossed, 1);
  for (const CrossedPart::Corners& triangle : crossed.Triangles)
  {
    this->BoundaryTriangles.push_back({ std::int32_t(triangle[0] - this->First),
      std::int32_t(triangle[1] - this->First), std::int32_t(triangle[2] - this->First) });
  }
}

/// Sets the values of points that represent duplicates. `figures` counts the positions whose points
/// disagree.
void LoadedPiece::resolveDuplicates(PieceFigures& figures)
{
  std::vector<Duplicate> duplicates;
  for (const auto& [point, representative] : this->Representatives)
  {
    duplicates.push_back({ point, representative });
  }
  std::vector<ValueColumn> columns;
  const std::size_t words = this->Work.Rows.Words;
  for (std::size_t word = 2; word + 1 < words; ++word)
  {
    columns.push_back({ this->Rows.data() + word, words });
  }
  figures.DisagreeingPositions += tipp::resolveDuplicates(
    std::move(duplicates), columns, this->Work.Elevation, this->Work.Duplicates);
}

PieceInterior LoadedPiece::writeInterior()
{
  std::sort(this->BoundaryTriangles.begin(), this->BoundaryTriangles.end());
  if (this->Constraints)
  {
    this->constrain();
    std::sort(this->BoundaryTriangles.begin(), this->BoundaryTriangles.end());
  }
  if (this->Work.Constraints && this->Work.Constraints->cutting().cuts())
  {
    this->filterTriangles([&](std::int32_t* corners, std::size_t count, PartitionIndex)
      { return cutTriangles(this->points(), this->Work.Constraints->cutting(), corners, count); });
  }
  if (this->Work.MaximumEdge > 0)
  {
    const auto pointOf = [this](std::int32_t id)
    {
      const double* const row = this->Rows.data() + std::size_t(id) * this->Work.Rows.Words;
      return Point2{ row[0], row[1] };
    };
    this->filterTriangles([&](std::int32_t* corners, std::size_t count, PartitionIndex)
      { return dropLongTriangles(corners, count, this->Work.MaximumEdge, pointOf); });
  }
  InteriorContent content;
  content.First = this->First;
  content.Points = std::int64_t(this->IsOnInterface.size());
  content.Rows = this->Rows.data();
  content.IsOnInterface = this->IsOnInterface.data();
  content.Representatives = &this->Representatives;
  for (PartitionIndex p = 0; p < this->Buckets.partitions(); ++p)
  {
    content.Triangles.push_back(
      { this->Buckets.triangles(p), this->InteriorCounts[std::size_t(p)] });
  }
  if (!this->BoundaryTriangles.empty())
  {
    content.Triangles.push_back(
      { this->BoundaryTriangles.front().data(), this->BoundaryTriangles.size() });
  }
  const std::size_t number = this->Work.Plan.number(this->Piece);
  if (this->Work.Consumer)
  {
    content.IsSummed = false;
    this->Work.Consumer->take(std::to_string(number), this->Rows.data(), this->Work.Rows,
      this->IsOnInterface.size(), content.Triangles);
  }
  return tipp::writeInterior(this->Work.Mesh, number, this->Work.Rows, content);
}

/// Writes the complete file of a piece that has no border.
FinishedPiece LoadedPiece::writeAlone()
{
  const PieceInterior interior = this->writeInterior();
  return writeBorder(this->Work.Mesh, this->Work.Plan.number(this->Piece), this->Work.Rows,
    interior, PieceBorder(interior, this->Work.Rows));
}

PieceResult LoadedPiece::write()
{
  this->resolveDuplicates(this->Result.Figures);
  this->Result.Interior = this->writeInterior();
  this->Constraints.reset();
  this->Rows = Buffer<double>();
  this->Buckets = PointBuckets<std::int32_t>();
  keepUnique(this->Result.HullVertices);
  return std::move(this->Result);
}

FinishedPiece LoadedPiece::writePointsAlone(PieceFigures& figures)
{
  std::vector<Duplicate> duplicates = sortOutDuplicates(this->points());
  for (Duplicate& duplicate : duplicates)
  {
    duplicate = { duplicate.Point + this->First, duplicate.Representative + this->First };
  }
  this->take(duplicates);
  figures.Duplicates += std::int64_t(duplicates.size());
  this->resolveDuplicates(figures);
  return this->writeAlone();
}

bool LoadedPiece::triangulateAlone(
  const DelaunayKernel::Monitor& progress, PieceFigures& figures, FinishedPiece& finished)
{
  Worker<std::int32_t> worker(this->Work.Plan.Partitions, this->Buckets);
  if (this->Constraints)
  {
    worker.setEditor(this->Constraints->makeEditor());
  }
  if (!worker.triangulateAlone(progress))
  {
    return false;
  }
  this->InteriorCounts[0] = worker.interiorCount();
  this->take(worker.duplicates());
  figures.Duplicates = std::int64_t(worker.duplicates().size());
  figures.WorkerVertices = std::int64_t(worker.vertexCount());
  this->resolveDuplicates(figures);
  finished = this->writeAlone();
  return true;
}

std::vector<FinishedPiece> triangulateAlone(const PieceWork& work, bool areCollinear,
  const std::function<bool(std::int64_t)>& progress, PieceFigures& figures)
{
  std::vector<FinishedPiece> pieces(std::size_t(work.Plan.pieces()));
  std::int64_t done = 0;
  for (PartitionIndex piece = 0; piece < work.Plan.pieces(); ++piece)
  {
    LoadedPiece loaded(work, piece);
    FinishedPiece& finished = pieces[work.Plan.number(piece)];
    bool isGoingOn = true;
    if (areCollinear)
    {
      finished = loaded.writePointsAlone(figures);
      isGoingOn = progress(done += work.Points.count(piece));
    }
    else
    {
      isGoingOn = loaded.triangulateAlone(
        [&](std::size_t inserted) { return progress(std::int64_t(inserted)); }, figures, finished);
    }
    if (!isGoingOn)
    {
      return {};
    }
  }
  return pieces;
}

} // namespace tipp
