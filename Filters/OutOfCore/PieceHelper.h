// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceHelper_h
#define tippPieceHelper_h

#include "Messages/Postbox.h"
#include "OutOfCore/LoadedPieces.h"
#include "OutOfCore/PieceMessages.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>

namespace tipp
{

/// What a rank other than the first does in a PieceRun: it loads the pieces it is told to,
/// triangulates their partitions and writes their interiors.
class VTKTIPPFILTERS_EXPORT PieceHelper
{
public:
  /// `progress` is told how many points this rank has triangulated; false ends the run on all
  /// ranks.
  PieceHelper(
    const PieceWork& work, Postbox& ranks, int threads, std::function<bool(std::int64_t)> progress);

  /// Until the first rank has no more work. Throws what its threads throw, and RankFailure.
  void run();

private:
  /// A partition to triangulate, or a piece to write.
  struct Task
  {
    bool IsInterior = false;
    PartitionTask Partition;
    InteriorTask Interior;
  };

  void serve();
  bool receive();
  void sendAnswers();
  void tell();
  void loadPieces();
  void work();
  void answer(MessageKind kind, Bytes content);
  void stop(const std::exception_ptr& reason);
  void guard(const std::function<void()>& body);

  Postbox& Ranks;
  LoadedPieces Pieces;
  const int Threads;
  const std::function<bool(std::int64_t)> Progress;

  std::mutex Mutex;
  std::condition_variable Changed;
  std::deque<LoadOrder> Loads;
  std::deque<Task> Tasks;
  std::deque<std::pair<MessageKind, Bytes>> Answers;
  std::int64_t PointsDone = 0;
  std::int64_t PointsTold = -1;
  bool Stopped = false;
  std::exception_ptr Failure;
};

} // namespace tipp

#endif
