// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceRun_h
#define tippPieceRun_h

#include "Messages/Postbox.h"
#include "OutOfCore/LoadedPieces.h"
#include "OutOfCore/PieceFigures.h"
#include "OutOfCore/PieceSchedule.h"
#include "Partitioned/PublishPieces.h"

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tipp
{

/// The threads that load pieces, triangulate their partitions and write them; and on the first of
/// several ranks the orders for the others, each of which has a PieceHelper.
class VTKTIPPFILTERS_EXPORT PieceRun
{
public:
  /// `progress` is told how many points are triangulated, in the thread that this object is made
  /// and run in; false ends the run. Ranks: null for this process alone.
  PieceRun(const PieceWork& work, const MemoryPlan& memory, int threads,
    std::function<bool(std::int64_t)> progress, Postbox* ranks = nullptr);

  /// Saves its state to this file now and then, and where progress ends it; and goes on from there
  /// if the file is there already. `aside`: a file for borders that there is no memory for; it
  /// belongs to the saved state. `rim`: one for the rim, which does not. `warn` is told, in one
  /// sentence, if what was saved is damaged: then all pieces are made again.
  void setCheckpoint(const std::string& path, const std::string& aside, const std::string& rim,
    std::function<void(const std::string&)> warn)
  {
    this->CheckpointPath = path;
    this->Aside = std::make_unique<AsideFile>(aside);
    this->SpilledRim = std::make_unique<VertexFile>(rim);
    this->Warn = std::move(warn);
  }

  /// Writes all pieces' files. Throws IOError, and RankFailure. False if progress ended it.
  bool triangulate();
  /// The same of points on one line: there are no triangles.
  bool writePointsAlone();
  /// The same of a single partition without artificial points.
  bool triangulateAlone();

  /// By their numbers in the mesh.
  std::vector<FinishedPiece>& finished() { return this->Finished; }

  const PieceFigures& figures() const { return this->Figures; }
  /// Of borders that were put aside.
  std::uint64_t asideBytes() const { return this->Aside ? this->Aside->end() : 0; }

private:
  using Lock = std::unique_lock<std::mutex>;
  using Place = LoadedPieces::Place;
  /// What is known of a rank, this one too.
  struct Rank
  {
    std::uint64_t LoadedBytes = 0;
    bool IsReady = false; ///< another rank
    int IdleThreads = 0;  ///< of another rank
    bool IsLoading = false;
  };

  PartitionIndex takeToLoad(int rank);
  void loadPieces();
  void work();
  PartitionIndex acquire(Place& place);
  void tell(Lock& lock);
  void addLoaded(PartitionIndex piece, int rank, Lock& lock);
  void bringBack(PartitionResult result);
  void countRim();
  void finishPiece(PartitionIndex piece, Lock& lock);
  void takeInterior(PartitionIndex piece, GrowingPiece interior);
  void writeBorders(Lock& lock);
  void stop(const std::exception_ptr& reason);
  /// The body of a thread; what it throws ends the run.
  void guard(const std::function<void()>& body);
  void runThreads();
  void start();
  void clearPieces();
  bool startFromCheckpoint();
  void loadCheckpoint();
  bool verifyWritten();
  void isolateInteriors();
  void useFiles();
  void saveSometimes();
  std::uint64_t saveNow();
  void save(SaveArchive& archive);

  /// @name Other ranks
  ///@{
  bool hasOtherRanks() const { return this->Ranks.size() > 1; }
  void serve();
  void take(const Message& message);
  bool giveOrders();
  ///@}

  const PieceWork Work;
  const MemoryPlan& Memory;
  const int Threads;
  const std::function<bool(std::int64_t)> Progress;
  Postbox* const Post;
  const std::thread::id Caller = std::this_thread::get_id();
  LoadedPieces Own;
  std::vector<Rank> Ranks;
  std::unique_ptr<PieceSchedule> Schedule;

  std::mutex Mutex;
  std::condition_variable Changed;
  std::string CheckpointPath;
  std::function<void(const std::string&)> Warn;
  std::unique_ptr<AsideFile> Aside;
  std::unique_ptr<VertexFile> SpilledRim;
  std::uint64_t RimBytesCounted = 0; ///< of those that this run has spilled
  std::uint64_t BytesSinceSaved = 0; ///< of interiors
  std::uint64_t SavedBytes = 0;      ///< of the last checkpoint
  PartitionIndex NextToLoad;
  PieceFigures Figures;
  std::int64_t PointsDone = 0;
  std::int64_t PointsTold = 0;
  bool Stopped = false;
  std::exception_ptr Failure;
  std::vector<FinishedPiece> Finished;
};

} // namespace tipp

#endif
