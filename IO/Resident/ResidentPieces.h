// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResidentPieces_h
#define tippResidentPieces_h

#include "Resident/MeshPart.h"
#include "vtkTIPPIOModule.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

class CellLocator;

/// What a query needs from a piece.
struct PieceNeeds
{
  std::vector<bool> Arrays; ///< per array of PartitionedMesh::Arrays; empty: none
  bool Locator = false;
  bool Topology = false;

  bool cover(const PieceNeeds& other) const;
  void add(const PieceNeeds& other);
};

/// A piece in memory, and the structures made for queries; null if no query needed them so far.
struct ResidentPiece
{
  std::shared_ptr<const MeshPart> Part;
  std::shared_ptr<const CellLocator> Locator;
  std::shared_ptr<const PartTopology> Topology;
  PieceNeeds Has;
};

/// The most recently used pieces of a mesh, within a memory limit. Thread-safe.
class VTKTIPPIO_EXPORT ResidentPieces
{
public:
  /// Loads a piece with what is needed. `before` is the piece as it is in memory, which may lack
  /// something.
  using Load = std::function<ResidentPiece(
    std::size_t number, const PieceNeeds& needs, const ResidentPiece& before)>;
  /// Estimates the bytes of memory for a piece with what is needed.
  using Estimate = std::function<std::uint64_t(std::size_t number, const PieceNeeds& needs)>;
  /// Throws an exception, because a piece needs more memory than the limit.
  using Refuse = std::function<void(std::size_t number, std::uint64_t bytes)>;

  ResidentPieces(std::uint64_t limit, Estimate estimate, Load load, Refuse refuse)
    : Limit(limit)
    , BytesOf(std::move(estimate))
    , LoadPiece(std::move(load))
    , RefusePiece(std::move(refuse))
  {
  }

  /// Whether a piece with these needs is within the limit.
  bool fits(std::size_t number, const PieceNeeds& needs) const
  {
    return this->BytesOf(number, needs) <= this->Limit;
  }
  /// Whether the pieces [first, end) with these needs are together within the limit.
  bool fit(std::size_t first, std::size_t end, const PieceNeeds& needs) const;

  /// A piece in use, which stays in memory as long as the Lease exists. A thread may hold only one:
  /// otherwise threads could wait for each other's memory forever.
  class Lease
  {
  public:
    Lease(ResidentPieces& pieces, std::size_t number, ResidentPiece piece)
      : Pieces(&pieces, Release{ number })
      , Held(std::move(piece))
    {
    }

    const ResidentPiece& operator*() const { return this->Held; }
    const ResidentPiece* operator->() const { return &this->Held; }

  private:
    struct Release
    {
      std::size_t Number;
      void operator()(ResidentPieces* pieces) const { pieces->release(this->Number); }
    };
    std::unique_ptr<ResidentPieces, Release> Pieces; ///< releases the piece after Held is destroyed
    ResidentPiece Held;
  };

  /// Returns a piece with what is needed. Loads it, and drops others, if necessary. Waits while
  /// other threads use the memory. Calls `refuse` if the piece exceeds the limit. Forwards
  /// exceptions of `load`. Without `stays`, the piece is dropped after its use unless another user
  /// wants it to stay: a query that reads more pieces than fit, each of them once, would only
  /// displace others.
  Lease get(std::size_t number, const PieceNeeds& needs, bool stays = true);

  struct GiveBack
  {
    std::uint64_t Bytes;
    bool IsActive; ///< from take()
    void operator()(ResidentPieces* pieces) const { pieces->giveBack(*this); }
  };
  /// Memory that is used for something other than pieces, until the destructor.
  using Share = std::unique_ptr<ResidentPieces, GiveBack>;

  /// Reserves memory for data of a piece that are not kept in memory. Waits like get(), and counts
  /// as a load. The thread must not hold a lease meanwhile. Returns null if `bytes` exceeds the
  /// limit.
  Share take(std::uint64_t bytes);
  /// Counts memory that is used in any case. Pieces leave space for it if possible.
  Share note(std::uint64_t bytes);

  /// Whether a piece is in memory with what is needed; and how often get() has returned it since it
  /// was loaded.
  bool isResident(std::size_t number, const PieceNeeds& needs = {}) const;
  int uses(std::size_t number) const;
  /// Counts a query of a piece, whether it is in memory or not. Returns the number of earlier ones.
  int countQuestion(std::size_t number);

  std::int64_t loads() const;  ///< number of pieces loaded so far
  std::uint64_t bytes() const; ///< memory of the pieces

private:
  struct Slot
  {
    ResidentPiece Held;
    std::uint64_t Bytes = 0;
    std::uint64_t LastUse = 0;
    int Users = 0;
    int Uses = 0;
    int Questions = 0;
    bool Loading = false;
    bool Stays = false;
  };

  void release(std::size_t number);
  void giveBack(const GiveBack& share);
  PieceNeeds needsWithin(
    std::unique_lock<std::mutex>& lock, std::size_t number, const PieceNeeds& needs, Slot& slot);
  void makeRoom(std::unique_lock<std::mutex>& lock, Slot& slot, std::uint64_t bytes);
  bool dropOldest(const Slot& keep);
  void drop(Slot& slot);

  const std::uint64_t Limit;
  Estimate BytesOf;
  Load LoadPiece;
  Refuse RefusePiece;
  mutable std::mutex Mutex;
  std::condition_variable Changed;
  std::unordered_map<std::size_t, Slot> Slots;
  std::uint64_t Used = 0;  ///< bytes of pieces in memory and of those being loaded
  std::uint64_t Noted = 0; ///< bytes of other data, from note()
  std::uint64_t Clock = 0;
  std::int64_t Loads = 0;
  int Active = 0; ///< number of leases, and of loads that have reserved their memory
};

} // namespace tipp

#endif
