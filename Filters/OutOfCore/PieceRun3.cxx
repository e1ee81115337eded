// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceRun.h"

#include "Engine/PartitionSchedule.h"
#include "Engine/RankEngine.h"
#include "Files/IOError.h"
#include "OutOfCore/FinishPieces.h"
#include "Parallel/Sort.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace tipp
{

namespace
{

/// Sorts the final tetrahedra of a piece into those of the interior and those at borders.
struct Cells : public FinalCellConsumer3
{
  Cells(const PieceWork3& work, PartitionIndex piece)
    : Piece(piece)
    , Number(std::int32_t(work.Plan.number(piece)))
    , First(work.Points.first(piece))
    , IsOnInterface(std::size_t(work.Points.count(piece)), 0)
    , Sorter(work.Plan, this->Borders)
  {
  }

  void addInside(const std::array<std::int64_t, 4>& ids) override
  {
    for (const std::int64_t id : ids)
    {
      this->Interior.push_back(std::int32_t(id - this->First));
    }
  }

  void add(const BoundaryCell<3>& corners) override
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
        this->addInside(idsOf(corners));
        return;
      }
      this->Sorter.add(corners, met);
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
  std::vector<std::int32_t> Interior; ///< four indices of the piece's points each
  std::vector<std::uint8_t> IsOnInterface;
  std::vector<Vertex3> HullVertices;
  BordersByOwner3 Borders;
  BorderSorter3 Sorter;
  SentMessages3 Sent;
};

/// A rank's part of a triangulation in space out of core. Its threads load pieces, as many at a
/// time as fit in memory, triangulate them, and write their results.
///
/// Pieces are assigned to ranks in order. A piece's messages to others are in its result, which all
/// ranks can read, so ranks only tell each other which pieces are done.
class PieceRun3 : private RankEngine<VertexMessage3>
{
public:
  PieceRun3(const PieceWork3& work, const MemoryPlan3& memory, int threads,
    const std::function<bool(double)>& progress, Communicator& ranks)
    : RankEngine(
        ranks, std::size_t(work.Plan.pieces()), std::size_t(work.Points.starts().back()), progress)
    , Work(work)
    , Memory(memory)
    , Threads(threads)
    , Initial(this->Inboxes.size())
    , Results(this->Inboxes.size())
  {
  }

  /// See triangulatePieces().
  void run(const std::vector<char>& isDone)
  {
    // Every piece has points, because its box holds points of the sample.
    const std::vector<char> isUsed(isDone.size(), 1);
    if (isDone.size() == 1)
    {
      this->makePieces(isDone, PartitionOrder(isUsed, ConflictGraph(1)));
      return;
    }
    const BoundaryCells<3> mesh = this->Work.Plan.initialMesh();
    const PartitionOrder order(isUsed, mesh);
    for (auto& [to, message] : sendInitialMesh(mesh, order))
    {
      this->Initial[std::size_t(to)] = std::move(message);
    }
    this->makePieces(isDone, order);
  }

private:
  std::int32_t ownerOf(PartitionIndex piece) const override
  {
    return std::int32_t(this->Order->position(piece) % std::size_t(this->Ranks.size()));
  }
  ReadyPartitions& source() override { return *this->Ready; }

  /// The first rank is told of all pieces, because it finishes them.
  std::vector<std::int32_t> recipientsOf(PartitionIndex piece) const override
  {
    std::vector<std::int32_t> ranks = RankEngine::recipientsOf(piece);
    ranks.push_back(0);
    sortUnique(ranks);
    return ranks;
  }

  void setDone(PartitionIndex piece) override
  {
    // Once this rank's pieces are done, it does not need the result, and the first rank may have
    // removed it.
    if (this->LeftPartitions > 0)
    {
      this->openResult(piece);
    }
    this->PointsDone += std::size_t(this->Work.Points.count(piece));
    this->Ready->finish(piece);
  }

  /// Reads where in a piece's result its messages are.
  void openResult(PartitionIndex piece)
  {
    auto stored = std::make_unique<StoredResult3>(this->Work.resultPath(piece));
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Results[std::size_t(piece)] = std::move(stored);
  }

  void makePieces(const std::vector<char>& isDone, const PartitionOrder& order)
  {
    this->Order = &order;
    std::vector<char> isPending(isDone.size(), 0);
    std::vector<PartitionIndex> left;
    for (const PartitionIndex piece : order.sequence())
    {
      const auto index = std::size_t(piece);
      isPending[index] = char(!isDone[index] && this->ownerOf(piece) == this->Ranks.rank());
      if (!isDone[index])
      {
        left.push_back(piece);
      }
    }
    this->begin(order, left);
    this->Ready =
      std::make_unique<ReadyPartitions>(order, ReadyPartitions::Waits::ForEarlier, isPending);
    for (std::size_t piece = 0; piece < isDone.size(); ++piece)
    {
      if (isDone[piece]) // later pieces find its messages in its result
      {
        this->Initial[piece] = {};
        this->setDone(PartitionIndex(piece));
      }
    }
    this->Ranks.barrier(); // a rank that is not set up yet could not handle messages
    std::vector<int> threads(std::size_t(this->Threads));
    this->runThreads(threads, [this](int) { this->work(); });
  }

  void work()
  {
    for (PartitionIndex piece = this->take(); piece != NoPartition; piece = this->take())
    {
      const std::uint64_t bytes = this->takeMemory(piece);
      if (!this->Ready->isStopped())
      {
        this->make(piece);
        {
          const std::lock_guard<std::mutex> lock(this->Mutex);
          this->LoadedBytes -= bytes;
        }
        this->finish(piece, {}, std::size_t(this->Work.Points.count(piece)));
      }
    }
  }

  /// Waits until there is memory for the piece, or the run is stopped. Returns the reserved bytes.
  std::uint64_t takeMemory(PartitionIndex piece)
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
    while (!this->Ready->isStopped() && this->LoadedBytes > 0 &&
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
    const double factor = this->Work.Factor;
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
      Worker3 worker(plan.Regions, *this->Order, InsideCells::OfRegion);
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
    this->openResult(piece);
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

  const PieceWork3 Work;
  const MemoryPlan3& Memory;
  const int Threads;
  std::unique_ptr<ReadyPartitions> Ready;
  std::vector<VertexMessage3> Initial; ///< by piece: its message from the initial mesh

  // Protected by Mutex.
  std::vector<std::unique_ptr<StoredResult3>> Results; ///< by piece; null: it is not done
  std::uint64_t LoadedBytes = 0;
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
    BorderSorter3 sorter(work.Plan, this->Late);
    repairHull(std::move(hull), work.Plan.Artificial, sorter);
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

void triangulatePieces(const PieceWork3& work, const MemoryPlan3& memory, int threads,
  const std::function<bool(double)>& progress, Communicator& ranks, const std::vector<char>& isDone)
{
  PieceRun3(work, memory, threads, progress, ranks).run(isDone);
}

std::vector<FinishedPiece> finishPieces(const PieceWork3& work, std::uint64_t limit, int threads,
  const Report& report, PieceFigures& figures)
{
  return PieceFinisher3(work, limit, figures).finish(threads, report);
}

} // namespace tipp
