// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceRun_h
#define tippPieceRun_h

#include "OutOfCore/PieceSchedule.h"
#include "Partitioned/PublishPieces.h"
#include "Triangulation/Worker.h"

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tipp
{

/// The threads that load pieces, triangulate their partitions and write them.
class VTKTIPPFILTERS_EXPORT PieceRun
{
public:
  /// `progress` is told how many points are triangulated, in the thread that this object is made
  /// and run in; false ends the run.
  PieceRun(const PiecePlan& plan, const SpilledPoints& points, double factor,
    const PointRowLayout& rows, const PartitionedMesh& mesh, const MemoryPlan& memory, int threads,
    std::function<bool(std::int64_t)> progress);

  /// Saves its state to this file now and then, and where progress ends it; and goes on from there
  /// if the file is there already.
  void setCheckpoint(const std::string& path) { this->CheckpointPath = path; }

  /// Writes all pieces' files. Throws IOError. False if progress ended it.
  bool triangulate();
  /// The same of points on one line: there are no triangles.
  bool writePointsAlone();
  /// The same of a single partition without artificial points.
  bool triangulateAlone();

  /// By their numbers in the mesh.
  std::vector<FinishedPiece>& finished() { return this->Finished; }

  std::int64_t Duplicates = 0;
  std::int64_t WorkerVertices = 0;
  std::int64_t PeakRimTriangles = 0;
  std::uint64_t PeakBorderBytes = 0;

private:
  struct Place;

  std::unique_ptr<LoadedPiece> load(PartitionIndex piece) const;
  std::uint64_t bytesOf(PartitionIndex piece) const;
  void loadPieces();
  void work();
  PartitionIndex acquire(Place& place);
  void tell(std::unique_lock<std::mutex>& lock);
  PartitionResult triangulate(Place& place, PartitionIndex partition);
  void bringBack(PartitionResult result);
  void writeInterior(PartitionIndex piece);
  void writeLoaded(PartitionIndex piece, LoadedPiece& loaded, GrowingPiece& growing);
  void writeWhole(PartitionIndex piece, LoadedPiece& loaded);
  void writeBorders(std::unique_lock<std::mutex>& lock);
  void stop(const std::exception_ptr& reason);
  /// The body of a thread; what it throws ends the run.
  void guard(const std::function<void()>& body);
  void runThreads();
  void start();
  bool startFromCheckpoint();
  void reload(PartitionIndex piece);
  void makeInteriors(PartitionIndex piece, LoadedPiece& loaded) const;
  void finishPiece(PartitionIndex piece, std::unique_lock<std::mutex>& lock);
  void saveSometimes(std::unique_lock<std::mutex>& lock);
  void save(SaveArchive& archive);
  template <typename Archive>
  void exchangeFinished(Archive& archive); ///< figures and finished pieces

  const PiecePlan& Plan;
  const SpilledPoints& Points;
  const double Factor;
  const PointRowLayout& Rows;
  const PartitionedMesh& Mesh;
  const MemoryPlan& Memory;
  const int Threads;
  const std::function<bool(std::int64_t)> Progress;
  const std::thread::id Caller = std::this_thread::get_id();
  std::unique_ptr<PieceSchedule> Schedule;

  std::mutex Mutex;
  std::condition_variable Changed;
  std::string CheckpointPath;
  bool IsSaving = false;
  std::uint64_t BytesSinceSaved = 0; ///< of interiors
  std::uint64_t SavedBytes = 0;      ///< of the last checkpoint
  std::uint64_t LoadedBytes = 0;
  std::int64_t PointsDone = 0;
  std::int64_t PointsTold = 0;
  bool Stopped = false;
  std::exception_ptr Failure;
  std::vector<FinishedPiece> Finished;
};

} // namespace tipp

#endif
