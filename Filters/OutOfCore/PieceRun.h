// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceRun_h
#define tippPieceRun_h

#include "Engine/ReadyPartitions.h"
#include "Engine/Routing.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/PieceConstraints.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "Partitioned/PieceWriter.h"
#include "Ranks/Communicator.h"
#include "Triangulation/Worker.h"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// A piece in memory: its points, whose partitions several threads triangulate, and its triangles
/// until they are written.
class VTKTIPPFILTERS_EXPORT LoadedPiece
{
public:
  /// Reads the points. Throws IOError.
  LoadedPiece(const PieceWork& work, PartitionIndex piece);

  /// Bytes that a piece takes in memory.
  static std::uint64_t bytesOf(const PieceWork& work, PartitionIndex piece);

  /// A thread's memory, which is kept from one partition to the next.
  struct Workspace
  {
    explicit Workspace(const PieceOrder& order)
      : Order(order)
    {
    }
    void clear()
    {
      this->Triangulator.reset();
      this->Router.reset();
      this->Unique = UniqueVertices();
    }

    const PieceOrder& Order;
    PartitionIndex Piece = -1;
    std::unique_ptr<Worker<std::int32_t>> Triangulator; ///< for that piece
    std::unique_ptr<Routing<std::int32_t>> Router;
    UniqueVertices Unique;
  };

  /// Triangulates a partition with what is in its inbox, and returns what it sends.
  SentMessages triangulate(
    Workspace& space, PartitionIndex partition, const std::vector<VertexMessage>& inbox);

  std::int64_t pointsOf(PartitionIndex partition) const
  {
    return std::int64_t(
      this->Buckets.count(partition - this->Work.Plan.FirstPartition[std::size_t(this->Piece)]));
  }

  /// When all partitions are triangulated: writes the interior's share of the piece's file in the
  /// mesh, frees the points, and returns the rest. Throws IOError.
  PieceResult write();

  /// @name A piece without a border
  /// Write the whole file.
  ///@{
  /// For points on one line: there are no triangles.
  FinishedPiece writePointsAlone(PieceFigures& figures);
  /// For the only piece, of one partition without artificial points. False if `progress` ended it.
  bool triangulateAlone(
    const DelaunayKernel::Monitor& progress, PieceFigures& figures, FinishedPiece& finished);
  ///@}

private:
  struct Finals;

  PointsView points() const;
  void prepare(Workspace& space);
  void take(Finals& finals, const SentMessages& sent);
  void take(const std::vector<Duplicate>& duplicates);
  bool owns(const BoundaryVertex& v) const;
  void markInterface(const BoundaryVertex& v);
  template <typename Filter>
  void filterTriangles(const Filter& filter);
  void constrain();
  void resolveDuplicates(PieceFigures& figures);
  PieceInterior writeInterior();
  FinishedPiece writeAlone();

  const PieceWork& Work;
  const PartitionIndex Piece;
  const std::int64_t First; ///< index of the first point among all spilled points
  Buffer<double> Rows;
  std::unique_ptr<PieceConstraints> Constraints; ///< null: none is near
  PointBuckets<std::int32_t> Buckets;
  std::vector<std::size_t> InteriorCounts; ///< triangles, of each partition

  std::mutex Mutex;                                               ///< for what follows
  std::unordered_map<std::int32_t, std::int32_t> Representatives; ///< of duplicates
  std::vector<std::uint8_t> IsOnInterface;                        ///< of each point
  std::vector<std::array<std::int32_t, 3>>
    BoundaryTriangles; ///< between partitions, but of the interior
  PieceResult Result;
};

/// Makes all pieces of a run whose pieces have no borders: the points are collinear, or there is
/// one piece. `progress` is called with the number of points that are done. Returns the pieces by
/// their numbers in the mesh; an empty list if `progress` ended it. Throws IOError.
std::vector<FinishedPiece> triangulateAlone(const PieceWork& work, bool areCollinear,
  const std::function<bool(std::int64_t)>& progress, PieceFigures& figures);

/// A rank's part of a triangulation out of core: it loads its pieces one after the other, as many
/// at a time as there is memory for, triangulates their partitions by threads, and writes what
/// comes of a piece when its last partition is done.
///
/// Pieces are dealt to ranks in order, and no rank is above the others. A message for a partition
/// goes to the rank that has its piece; it is in memory until the sender's piece is on disk, unless
/// the recipient's piece is loaded: then it is in an inbox. So memory holds what belongs to pieces
/// that are being worked on, and all else is in the results of pieces that are done.
class VTKTIPPFILTERS_EXPORT PieceRun
{
public:
  /// `progress` is told how many points are triangulated, in the thread that runs this; false ends
  /// the run. Ranks: null for this process alone.
  PieceRun(const PieceWork& work, const MemoryPlan& memory, int threads,
    std::function<bool(std::int64_t)> progress, Communicator* ranks = nullptr);

  /// Writes the results of all pieces that are not done yet: `isDone` has an entry for each piece,
  /// the same on all ranks. Throws IOError, and RankFailure. False if progress ended it. With
  /// ranks, the first one returns when all are done, and the others when it tells them to end.
  bool run(const std::vector<char>& isDone);

private:
  using Lock = std::unique_lock<std::mutex>;
  /// A message to another rank.
  struct Outgoing
  {
    int Rank;
    MessageKind Kind;
    Bytes Content;
  };
  /// What is known of a piece.
  struct Piece
  {
    int Rank = 0; ///< which triangulates it
    PartitionIndex PartitionsLeft = 0;
    std::unique_ptr<LoadedPiece> Loaded;
    std::unique_ptr<StoredResult> Result; ///< once it is done; only of those for this rank
    SentMessages Pending;                 ///< to its partitions, until it is loaded
  };

  int rank() const { return this->Post ? this->Post->rank() : 0; }
  bool hasOtherRanks() const { return this->Post && this->Post->size() > 1; }
  bool isOwn(PartitionIndex piece) const { return this->at(piece).Rank == this->rank(); }
  Piece& at(PartitionIndex piece) { return this->Pieces[std::size_t(piece)]; }
  const Piece& at(PartitionIndex piece) const { return this->Pieces[std::size_t(piece)]; }
  PartitionIndex pieceOf(PartitionIndex partition) const
  {
    return this->Work.Plan.PieceOf[std::size_t(partition)];
  }

  void prepare(const std::vector<char>& isDone);
  void writeEmptyPieces(const std::vector<char>& isDone);
  void loadPieces();
  bool waitForMemory(PartitionIndex piece);
  void load(PartitionIndex piece);
  void work();
  void finishPartition(PartitionIndex p, SentMessages sent);
  void sendToRanks(PartitionIndex p, const SentMessages& sent);
  void deliver(PartitionIndex to, VertexMessage message);
  void finishPiece(PartitionIndex piece);
  std::vector<PartitionIndex> setDone(PartitionIndex piece);
  void takeBorders(const std::vector<PartitionIndex>& pieces);
  bool tell();

  void runThreads();
  void guard(const std::function<void()>& body);
  void stop(const std::exception_ptr& reason);

  /// @name The thread that speaks to other ranks
  ///@{
  void coordinate();
  bool sendAndReceive();
  void receive(const Message& message);
  void receivePartition(const Message& message);
  ///@}

  const PieceWork Work;
  const MemoryPlan& Memory;
  const int Threads;
  const std::function<bool(std::int64_t)> Progress;
  Communicator* const Post;
  const std::thread::id Caller = std::this_thread::get_id();
  std::unique_ptr<PieceOrder> Order;
  std::unique_ptr<ReadyPartitions> Ready;
  std::vector<Inbox> Inboxes; ///< of each partition; filled while its piece is loaded

  std::mutex Mutex; ///< for what follows
  std::condition_variable Changed;
  std::vector<Piece> Pieces;
  std::unique_ptr<BorderQueue> Borders; ///< null: there is no taker
  std::size_t PiecesLeft = 0;           ///< that this rank waits for
  std::uint64_t LoadedBytes = 0;
  std::int64_t PointsDone = 0;
  std::int64_t PointsTold = -1;
  bool IsEnded = false; ///< the first rank has told so
  std::vector<Outgoing> ToSend;
};

} // namespace tipp

#endif
