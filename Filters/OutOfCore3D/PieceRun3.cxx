// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore3D/PieceRun3.h"

#include "Engine/PartitionSchedule.h"
#include "Files/IOError.h"
#include "OutOfCore/FinishPieces.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates3.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace tipp
{

const std::vector<std::int32_t>& BorderSorter3::findMet(const std::array<Vertex3, 4>& corners)
{
  Box3 bounds = Box3::empty();
  for (const Vertex3& v : corners)
  {
    bounds.extend(v.Position);
  }
  this->Met.clear();
  this->Plan.tiling().visitMet(bounds,
    [&](PartitionIndex piece)
    {
      if (tetrahedronMeetsBox(corners[0].Position, corners[1].Position, corners[2].Position,
            corners[3].Position, this->Plan.box(piece)))
      {
        this->Met.push_back(std::int32_t(this->Plan.number(piece)));
      }
    });
  std::sort(this->Met.begin(), this->Met.end());
  if (this->Met.empty())
  {
    throw std::runtime_error("a tetrahedron lies outside of all pieces");
  }
  return this->Met;
}

void BorderSorter3::add(const std::array<Vertex3, 4>& corners, const std::vector<std::int32_t>& met,
  BordersByOwner3& borders) const
{
  const auto owner = PartitionIndex(this->Plan.number(met.front()));
  borders[owner].add({ corners[0].Id, corners[1].Id, corners[2].Id, corners[3].Id }, met);
}

namespace
{

/// Sorts the final tetrahedra of a piece into those of the interior and those at borders.
struct Cells : public FinalCellConsumer3
{
  Cells(const PieceWork3& work, PartitionIndex piece)
    : Piece(piece)
    , Number(std::int32_t(work.Plan.number(piece)))
    , First(work.Points.first(piece))
    , Sorter(work.Plan)
    , IsOnInterface(std::size_t(work.Points.count(piece)), 0)
  {
  }

  void addInside(const std::array<std::int64_t, 4>& ids) override
  {
    for (const std::int64_t id : ids)
    {
      this->Interior.push_back(std::int32_t(id - this->First));
    }
  }

  void add(const std::array<Vertex3, 4>& corners) override
  {
    const bool isHull = takeHullVertices(corners, this->HullVertices);
    if (!isHull)
    {
      const std::vector<std::int32_t>& met = this->Sorter.findMet(corners);
      const bool isOwn = met.size() == 1 && met.front() == this->Number &&
        std::all_of(corners.begin(), corners.end(),
          [this](const Vertex3& v) { return v.Partition == this->Piece; });
      if (isOwn)
      {
        this->addInside({ corners[0].Id, corners[1].Id, corners[2].Id, corners[3].Id });
        return;
      }
      this->Sorter.add(corners, met, this->Borders);
    }
    for (const Vertex3& v : corners)
    {
      this->markInterface(v);
    }
  }

  void markInterface(const Vertex3& v)
  {
    if (v.Partition == this->Piece)
    {
      this->IsOnInterface[std::size_t(v.Id - this->First)] = 1;
    }
  }

  const PartitionIndex Piece;
  const std::int32_t Number;
  const std::int64_t First;
  BorderSorter3 Sorter;
  std::vector<std::int32_t> Interior; ///< four indices of the piece's points each
  std::vector<std::uint8_t> IsOnInterface;
  std::vector<Vertex3> HullVertices;
  BordersByOwner3 Borders;
  SentMessages3 Sent;
};

/// Loads pieces, as many at a time as fit in memory, triangulates them in threads, and writes their
/// results.
class PieceRun3
{
public:
  PieceRun3(const PieceWork3& work, const MemoryPlan3& memory, int threads,
    std::function<bool(std::int64_t)> progress)
    : Work(work)
    , Memory(memory)
    , Threads(threads)
    , Progress(std::move(progress))
  {
  }

  /// See triangulatePieces().
  bool run(const std::vector<char>& isDone)
  {
    const PiecePlan3& plan = this->Work.Plan;
    this->Results.resize(isDone.size());
    // Every piece has points, because its box holds points of the sample.
    const std::vector<char> isUsed(isDone.size(), 1);
    this->Initial.resize(isDone.size());
    if (plan.pieces() == 1)
    {
      return this->makePieces(isDone, PartitionOrder(isUsed, ConflictGraph(1)));
    }
    const InitialMesh3 mesh = plan.initialMesh();
    const PartitionOrder order(isUsed, mesh);
    for (auto& [to, message] : sendInitialMesh(mesh, order))
    {
      this->Initial[std::size_t(to)] = std::move(message);
    }
    return this->makePieces(isDone, order);
  }

private:
  /// Marks pieces that are done: later pieces find their messages in the results.
  void skipDone(const std::vector<char>& isDone, ReadyPartitions& ready)
  {
    for (std::size_t piece = 0; piece < isDone.size(); ++piece)
    {
      if (isDone[piece])
      {
        const auto index = PartitionIndex(piece);
        this->Results[piece] = std::make_unique<StoredResult3>(this->Work.resultPath(index));
        this->Initial[piece] = {};
        this->PointsDone += this->Work.Points.count(index);
        ready.finish(index);
      }
    }
  }

  /// Returns false if the run was stopped.
  bool makePieces(const std::vector<char>& isDone, const PartitionOrder& order)
  {
    this->Order = &order;
    std::vector<char> isPending;
    isPending.reserve(isDone.size());
    for (const char done : isDone)
    {
      isPending.push_back(char(done == 0));
    }
    ReadyPartitions ready(order, ReadyPartitions::Waits::ForEarlier, isPending);
    this->skipDone(isDone, ready);
    runWorkers(ready, this->Threads,
      [&](int)
      {
        for (PartitionIndex piece = ready.take(); piece >= 0; piece = ready.take())
        {
          const std::uint64_t bytes = this->takeMemory(piece, ready);
          if (!ready.isStopped())
          {
            this->make(piece);
            ready.finish(piece);
            this->finish(piece, bytes, ready);
          }
        }
      });
    return !ready.isStopped();
  }

  /// Waits until there is memory for the piece, or the run is stopped. Returns the reserved bytes.
  std::uint64_t takeMemory(PartitionIndex piece, const ReadyPartitions& ready)
  {
    constexpr std::chrono::milliseconds pause(10);
    std::unique_lock<std::mutex> lock(this->Mutex);
    std::int64_t others = std::int64_t(this->Initial[std::size_t(piece)].Vertices.size());
    for (const auto& result : this->Results)
    {
      others += result ? std::int64_t(result->sentBytes(piece) / sizeof(Vertex3)) : 0;
    }
    const std::int64_t points = this->Work.Points.count(piece);
    const std::uint64_t bytes = MemoryPlan3::bytesOf(points, others, this->Work.Rows.Words);
    constexpr std::uint64_t always = std::uint64_t(64) << 20;
    if (bytes > std::max(this->Memory.PieceBytes, always))
    {
      throw IOError("Spheres through these points are so large that a piece of " +
        std::to_string(points) + " points needs " + std::to_string(others) +
        " points of others, and " + std::to_string(bytes / 800000 + 1) +
        " MB in all; allow more memory.");
    }
    while (!ready.isStopped() && this->LoadedBytes > 0 &&
      this->LoadedBytes + bytes > this->Memory.PieceBytes)
    {
      this->Changed.wait_for(lock, pause);
    }
    this->LoadedBytes += bytes;
    return bytes;
  }

  std::vector<VertexMessage3> readInbox(PartitionIndex piece)
  {
    std::vector<VertexMessage3> inbox;
    inbox.push_back(std::move(this->Initial[std::size_t(piece)]));
    for (std::size_t sender = 0; sender < this->Results.size(); ++sender)
    {
      const StoredResult3* result = nullptr;
      {
        const std::lock_guard<std::mutex> lock(this->Mutex);
        result = this->Results[sender].get();
      }
      if (result && result->sentBytes(piece) > 0)
      {
        inbox.push_back(std::move(result->readMessages(piece).front().second));
      }
    }
    return inbox;
  }

  void make(PartitionIndex piece)
  {
    const PiecePlan3& plan = this->Work.Plan;
    const auto count = std::size_t(this->Work.Points.count(piece));
    const std::size_t words = this->Work.Rows.Words;
    const double factor = plan.survey().Factor;
    const auto z = std::size_t(this->Work.Rows.Z);
    Buffer<double> rows(count * words);
    this->Work.Points.read(piece, rows.data());
    Cells cells(this->Work, piece);
    cells.Interior.reserve(4 * 7 * count);
    std::vector<Duplicate> duplicates;
    PieceFigures figures;
    {
      std::vector<Point3> points(count);
      for (std::size_t i = 0; i < count; ++i)
      {
        const double* const row = rows.data() + i * words;
        points[i] = { row[0] * factor, row[1] * factor, row[z] * factor };
      }
      Worker3 worker(plan.regions(), *this->Order, InsideCells::OfRegion);
      const PartitionPoints3 own{ piece, points.data(), count, nullptr, cells.First };
      cells.Sent = worker.triangulate(own, this->readInbox(piece), cells);
      duplicates = worker.duplicates();
      figures.WorkerVertices = std::int64_t(worker.vertexCount());
    }
    figures.Duplicates = std::int64_t(duplicates.size());
    PieceResult3 result = this->write(piece, rows, cells, duplicates);
    for (auto& [to, message] : cells.Sent)
    {
      figures.BoundaryBytes += message.Vertices.size() * sizeof(Vertex3);
      result.Sent[to].emplace_back(to, std::move(message));
    }
    result.Figures = figures;
    StoredResult3::write(this->Work.resultPath(piece), result);
    auto stored = std::make_unique<StoredResult3>(this->Work.resultPath(piece));
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Results[std::size_t(piece)] = std::move(stored);
  }

  /// Writes the interior's part of the piece's file in the mesh. Returns the remaining results.
  PieceResult3 write(PartitionIndex piece, const Buffer<double>& rows, Cells& cells,
    const std::vector<Duplicate>& duplicates)
  {
    for (const auto& [to, message] : cells.Sent)
    {
      for (const Vertex3& v : message.Vertices)
      {
        cells.markInterface(v);
      }
    }
    std::unordered_map<std::int32_t, std::int32_t> representatives;
    for (const Duplicate& duplicate : duplicates)
    {
      representatives.emplace(std::int32_t(duplicate.Point - cells.First),
        std::int32_t(duplicate.Representative - cells.First));
    }
    InteriorContent content;
    content.First = cells.First;
    content.Points = std::int64_t(cells.IsOnInterface.size());
    content.Rows = rows.data();
    content.IsOnInterface = cells.IsOnInterface.data();
    content.Triangles = { { cells.Interior.data(), cells.Interior.size() / 4 } };
    content.Representatives = &representatives;
    PieceResult3 result;
    result.Interior =
      writeInterior(this->Work.Mesh, this->Work.Plan.number(piece), this->Work.Rows, content);
    keepUnique(cells.HullVertices);
    result.HullVertices = std::move(cells.HullVertices);
    result.Borders = std::move(cells.Borders);
    return result;
  }

  /// Frees the memory of a piece that is done, and reports progress.
  void finish(PartitionIndex piece, std::uint64_t bytes, ReadyPartitions& ready)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->LoadedBytes -= bytes;
    this->PointsDone += this->Work.Points.count(piece);
    if (!ready.isStopped() && !this->Progress(this->PointsDone))
    {
      ready.stop();
    }
    this->Changed.notify_all();
  }

  const PieceWork3 Work;
  const MemoryPlan3& Memory;
  const int Threads;
  const std::function<bool(std::int64_t)> Progress;
  const PartitionOrder* Order = nullptr;
  std::vector<VertexMessage3> Initial; ///< by piece: its message from the initial mesh

  std::mutex Mutex; ///< protects the members below
  std::condition_variable Changed;
  std::vector<std::unique_ptr<StoredResult3>> Results; ///< by piece; null: it is not done
  std::uint64_t LoadedBytes = 0;
  std::int64_t PointsDone = 0;
};

class PieceFinisher3 : public PieceFinisherOf<PieceWork3, 4>
{
public:
  /// `limit`: bytes of memory for the hull repair.
  PieceFinisher3(const PieceWork3& work, std::uint64_t limit, PieceFigures& figures)
    : PieceFinisherOf(work, figures)
  {
    std::vector<Vertex3> hull = this->readHullVertices();
    const std::uint64_t bytes = MemoryPlan3::bytesOf(std::int64_t(hull.size()), 0, 0);
    constexpr std::uint64_t always = std::uint64_t(64) << 20;
    if (bytes > std::max(limit, always))
    {
      throw IOError("There are " + std::to_string(hull.size()) +
        " points at the convex hull, which take " + std::to_string(bytes / 1000000 + 1) +
        " MB; allow more memory.");
    }
    BorderSorter3 sorter(work.Plan);
    repairHull(std::move(hull), work.Plan.artificial(),
      [&](const std::array<Vertex3, 4>& corners)
      { sorter.add(corners, sorter.findMet(corners), this->Late); });
  }

protected:
  FinishedPiece make(PartitionIndex piece) const override
  {
    const PieceInterior interior = this->readInterior(piece);
    PieceBorder border(interior, this->Work.Rows, 4);
    this->forEachBorder(
      piece, [&border](const BorderCells3& cells) { addCells(cells, {}, border); });
    return this->write(piece, interior, border);
  }
};

} // namespace

bool triangulatePieces(const PieceWork3& work, const MemoryPlan3& memory, int threads,
  const std::function<bool(std::int64_t)>& progress, const std::vector<char>& isDone)
{
  return PieceRun3(work, memory, threads, progress).run(isDone);
}

std::vector<FinishedPiece> finishPieces(const PieceWork3& work, std::uint64_t limit, int threads,
  const Report& report, PieceFigures& figures)
{
  return PieceFinisher3(work, limit, figures).finish(threads, report);
}

} // namespace tipp
