// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/LoadedPieces.h"

#include "Distributed/VertexLabelling.h"
#include "Triangulation/DegenerateInput.h"

#include <algorithm>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace tipp
{
namespace
{

/// Whether a worker keeps its memory for the next partition. Where most vertices are those of the
/// rim, partitions do not pay, and hardly two are worked on together.
bool isWorthKeeping(std::size_t vertices, std::size_t points)
{
  constexpr std::size_t some = 16384;
  return vertices <= 2 * points + some;
}

/// The lowest point of each place is to stand for the others, also where another one was in the
/// initial mesh: once its partition is finished, all triangles that have it are those of its
/// worker. Renames it everywhere.
void preferLowest(std::vector<Duplicate>& duplicates, SeamGroups& seams, std::int32_t* interior,
  std::size_t corners, std::int64_t first)
{
  std::unordered_map<std::int64_t, std::int64_t> lowest;
  for (const Duplicate& duplicate : duplicates)
  {
    if (duplicate.Point < duplicate.Representative)
    {
      std::int64_t& low = lowest.emplace(duplicate.Representative, duplicate.Point).first->second;
      low = std::min(low, duplicate.Point);
    }
  }
  if (lowest.empty())
  {
    return;
  }
  const auto renamed = [&](std::int64_t id)
  {
    const auto found = lowest.find(id);
    return found == lowest.end() ? id : found->second;
  };
  for (Duplicate& duplicate : duplicates)
  {
    const std::int64_t low = renamed(duplicate.Representative);
    duplicate = { duplicate.Point == low ? duplicate.Representative : duplicate.Point, low };
  }
  for (PlainVertex& v : seams.Vertices)
  {
    v.Id = renamed(v.Id);
  }
  for (std::size_t i = 0; i < corners; ++i)
  {
    interior[i] = std::int32_t(renamed(first + interior[i]) - first);
  }
}

} // namespace

/// A piece's points and triangles while its partitions are worked on.
struct LoadedPieces::Loaded
{
  std::int64_t First = 0; ///< place among all points
  Buffer<double> Rows;
  PointBuckets<std::int32_t> Buckets;
  std::vector<std::size_t> InteriorCounts; ///< triangles, of each partition
  std::unordered_map<std::int32_t, std::int32_t> Representatives;
  std::mutex Mutex; ///< for them

  void add(const std::vector<Duplicate>& duplicates)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const Duplicate& duplicate : duplicates)
    {
      this->Representatives.emplace(std::int32_t(duplicate.Point - this->First),
        std::int32_t(duplicate.Representative - this->First));
    }
  }
};

LoadedPieces::LoadedPieces(const PieceWork& work)
  : Work(work)
  , Pieces(std::size_t(work.Plan.pieces()))
{
}

LoadedPieces::~LoadedPieces() = default;

std::uint64_t LoadedPieces::bytesOf(PartitionIndex piece) const
{
  return MemoryPlan::pieceBytes(this->Work.Points.count(piece), this->Work.Rows.Words);
}

std::unique_ptr<LoadedPieces::Loaded> LoadedPieces::read(PartitionIndex piece) const
{
  auto loaded = std::make_unique<Loaded>();
  const auto count = std::size_t(this->Work.Points.count(piece));
  loaded->First = this->Work.Points.starts()[std::size_t(piece)];
  loaded->Rows = Buffer<double>(count * this->Work.Rows.Words);
  this->Work.Points.read(piece, loaded->Rows.data());
  const PointsView view(loaded->Rows.data(), count, this->Work.Rows.Words);
  const Tiling& inner = this->Work.Plan.Inner[std::size_t(piece)];
  loaded->Buckets = bucketPoints<std::int32_t>(view.scaled(this->Work.Factor), inner, 1);
  loaded->InteriorCounts.assign(std::size_t(inner.size()), 0);
  return loaded;
}

void LoadedPieces::load(PartitionIndex piece, const std::vector<PartitionIndex>& finished)
{
  std::unique_ptr<Loaded> loaded = this->read(piece);
  this->makeInteriors(piece, finished, *loaded);
  this->Pieces[std::size_t(piece)] = std::move(loaded);
}

/// Interior triangles depend on a partition's own points alone, so those of finished partitions are
/// made again rather than saved.
void LoadedPieces::makeInteriors(
  PartitionIndex piece, const std::vector<PartitionIndex>& finished, Loaded& loaded) const
{
  if (finished.empty())
  {
    return;
  }
  const PiecePlan& plan = this->Work.Plan;
  const PartitionIndex first = plan.FirstPartition[std::size_t(piece)];
  Worker<std::int32_t> worker(plan.Partitions, loaded.Buckets, loaded.First);
  worker.setTiling(plan.Partitions, -first);
  for (const PartitionIndex partition : finished)
  {
    worker.triangulate(partition, std::vector<SeamVertex>(plan.Artificial));
    loaded.InteriorCounts[std::size_t(partition - first)] = worker.interiorCount();
    loaded.add(worker.duplicates());
  }
}

/// Has a worker for the piece's partitions.
void LoadedPieces::prepare(Place& place, PartitionIndex piece)
{
  if (place.Piece == piece)
  {
    return;
  }
  const PiecePlan& plan = this->Work.Plan;
  Loaded& loaded = *this->Pieces[std::size_t(piece)];
  place.Triangulator.reset(); // gives its kernel to the next
  place.Triangulator =
    std::make_unique<Worker<std::int32_t>>(plan.Partitions, loaded.Buckets, loaded.First);
  place.Triangulator->setTiling(plan.Partitions, -plan.FirstPartition[std::size_t(piece)]);
  place.Piece = piece;
}

PartitionResult LoadedPieces::triangulate(Place& place, PartitionIndex partition)
{
  const PiecePlan& plan = this->Work.Plan;
  const PartitionIndex piece = plan.PieceOf[std::size_t(partition)];
  const PartitionIndex inPiece = partition - plan.FirstPartition[std::size_t(piece)];
  Loaded& loaded = *this->Pieces[std::size_t(piece)];
  this->prepare(place, piece);
  Worker<std::int32_t>& worker = *place.Triangulator;
  std::vector<SeamVertex> vertices = labelVertices(plan.Partitions, place.Vertices);
  std::vector<PlainVertex>().swap(place.Vertices);
  worker.triangulate(partition, std::move(vertices));
  PartitionResult result;
  result.Partition = partition;
  result.Points = std::int64_t(loaded.Buckets.count(inPiece));
  result.Vertices = std::int64_t(worker.vertexCount());
  loaded.InteriorCounts[std::size_t(inPiece)] = worker.interiorCount();
  std::vector<Duplicate> duplicates = worker.duplicates();
  const SeamTriangles seams = worker.takeSeams();
  if (isWorthKeeping(worker.vertexCount(), loaded.Buckets.count(inPiece)))
  {
    result.Seams = place.Grouping.group(seams);
  }
  else
  {
    place = Place();
    result.Seams = SeamGrouping().group(seams);
  }
  result.Duplicates = std::int64_t(duplicates.size());
  preferLowest(duplicates, result.Seams, loaded.Buckets.triangles(inPiece),
    3 * loaded.InteriorCounts[std::size_t(inPiece)], loaded.First);
  loaded.add(duplicates);
  return result;
}

GrowingPiece LoadedPieces::writeInterior(const InteriorTask& task)
{
  const std::unique_ptr<Loaded> loaded = std::move(this->Pieces[std::size_t(task.Piece)]);
  return this->write(task, *loaded);
}

GrowingPiece LoadedPieces::write(const InteriorTask& task, Loaded& loaded) const
{
  std::vector<std::uint8_t> rim(std::size_t(this->Work.Points.count(task.Piece)), 0);
  for (const std::int32_t point : task.Rim)
  {
    rim[std::size_t(point)] = 1;
  }
  GrowingPiece::Interior interior;
  interior.Rows = loaded.Rows.data();
  interior.Rim = rim.data();
  interior.Representatives = &loaded.Representatives;
  for (PartitionIndex p = 0; p < loaded.Buckets.partitions(); ++p)
  {
    interior.Triangles.push_back(
      { loaded.Buckets.triangles(p), loaded.InteriorCounts[std::size_t(p)] });
  }
  std::vector<std::array<std::int32_t, 3>> seams = task.Seams;
  std::sort(seams.begin(), seams.end());
  if (!seams.empty())
  {
    interior.Triangles.push_back({ seams.front().data(), seams.size() });
  }
  GrowingPiece growing(loaded.First, this->Work.Points.count(task.Piece));
  growing.writeInterior(
    this->Work.Mesh, this->Work.Plan.number(task.Piece), this->Work.Rows, interior);
  return growing;
}

std::int64_t LoadedPieces::writePointsAlone(PartitionIndex piece, FinishedPiece& finished)
{
  const std::unique_ptr<Loaded> loaded = this->read(piece);
  const PointsView view(
    loaded->Rows.data(), std::size_t(this->Work.Points.count(piece)), this->Work.Rows.Words);
  std::vector<Duplicate> duplicates = sortOutDuplicates(view);
  for (Duplicate& duplicate : duplicates)
  {
    duplicate = { duplicate.Point + loaded->First, duplicate.Representative + loaded->First };
  }
  loaded->add(duplicates);
  InteriorTask task;
  task.Piece = piece;
  finished = this->write(task, *loaded)
               .writeBorder(this->Work.Mesh, this->Work.Plan.number(piece), this->Work.Rows);
  return std::int64_t(duplicates.size());
}

bool LoadedPieces::triangulateAlone(
  const DelaunayKernel::Monitor& proceed, PartitionResult& result, FinishedPiece& finished)
{
  const std::unique_ptr<Loaded> loaded = this->read(0);
  Worker<std::int32_t> worker(this->Work.Plan.Partitions, loaded->Buckets);
  if (!worker.triangulateAlone(proceed))
  {
    return false;
  }
  loaded->InteriorCounts[0] = worker.interiorCount();
  loaded->add(worker.duplicates());
  result.Duplicates = std::int64_t(worker.duplicates().size());
  result.Vertices = std::int64_t(worker.vertexCount());
  finished = this->write(InteriorTask(), *loaded)
               .writeBorder(this->Work.Mesh, this->Work.Plan.number(0), this->Work.Rows);
  return true;
}

} // namespace tipp
