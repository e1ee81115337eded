// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResidentPieces_h
#define tippResidentPieces_h

#include "Query/MeshPart.h"
#include "vtkTIPPIOModule.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

class CellLocator;
class PartTopology;

/// What a query needs of a piece.
struct PieceNeeds
{
  std::vector<bool> Arrays; ///< for each of PartitionedMesh::Arrays; empty: none
  bool Locator = false;
  bool Topology = false;

  bool cover(const PieceNeeds& other) const;
  void add(const PieceNeeds& other);
};

/// A piece in memory and what has been made for queries; null where nobody needed it.
struct ResidentPiece
{
  std::shared_ptr<const MeshPart> Part;
  std::shared_ptr<const CellLocator> Locator;
  std::shared_ptr<const PartTopology> Topology;
  PieceNeeds Has;
};

/// The pieces of a mesh that are in memory, within a limit: those used last. Threads may share it.
class VTKTIPPIO_EXPORT ResidentPieces
{
public:
  /// Loads a piece with its arrays, or returns what it is given first with more.
  using Load = std::function<ResidentPiece(
    std::size_t number, const PieceNeeds& needs, const ResidentPiece& before)>;
  /// The memory in bytes that a piece takes.
  using Estimate = std::function<std::uint64_t(std::size_t number, const PieceNeeds& needs)>;
  /// Throws, since a piece takes more than the limit.
  using Refuse = std::function<void(std::size_t number, std::uint64_t bytes)>;

  ResidentPieces(std::uint64_t limit, Estimate estimate, Load load, Refuse refuse)
    : Limit(limit)
    , BytesOf(std::move(estimate))
    , LoadPiece(std::move(load))
    , RefusePiece(std::move(refuse))
  {
  }

  /// Whether a piece with what is needed is within the limit.
  bool fits(std::size_t number, const PieceNeeds& needs) const
  {
    return this->BytesOf(number, needs) <= this->Limit;
  }
  /// Whether the pieces [first, end) are within the limit together.
  bool fit(std::size_t first, std::size_t end, const PieceNeeds& needs) const;

  /// A piece in use: it stays in memory as long as this lives. A thread holds one at a time; else
  /// threads could wait for each other's memory forever.
  class Lease
  {
  public:
    Lease(ResidentPieces& pieces, std::size_t number, ResidentPiece piece)
      : Of(&pieces)
      , Number(number)
      , Held(std::move(piece))
    {
    }
    Lease(Lease&& other) noexcept
      : Of(std::exchange(other.Of, nullptr))
      , Number(other.Number)
      , Held(std::move(other.Held))
    {
    }
    Lease& operator=(Lease&&) = delete;
    ~Lease() { this->Of ? this->Of->release(*this) : void(); }

    const ResidentPiece& operator*() const { return this->Held; }
    const ResidentPiece* operator->() const { return &this->Held; }

  private:
    friend class ResidentPieces;
    ResidentPieces* Of;
    std::size_t Number;
    ResidentPiece Held;
  };

  /// Returns a piece with what is needed, loading it and dropping others as required. Waits while
  /// other threads use the memory. A piece that is larger than the limit is refused. What `load`
  /// throws is passed on. A piece stays in memory after its use unless no user wants it to: one
  /// that reads more pieces than fit, each once, would only displace others.
  Lease get(std::size_t number, const PieceNeeds& needs, bool stays = true);

  /// Memory for other things than pieces, until it ends.
  class Share
  {
  public:
    Share(ResidentPieces& pieces, std::uint64_t bytes, bool isActive)
      : Of(&pieces)
      , Bytes(bytes)
      , IsActive(isActive)
    {
    }
    Share(Share&& other) noexcept
      : Of(std::exchange(other.Of, nullptr))
      , Bytes(other.Bytes)
      , IsActive(other.IsActive)
    {
    }
    Share& operator=(Share&&) = delete;
    ~Share() { this->Of ? this->Of->giveBack(*this) : void(); }

  private:
    friend class ResidentPieces;
    ResidentPieces* Of;
    std::uint64_t Bytes;
    bool IsActive;
  };

  /// For what is made of a piece that does not stay in memory; waits as get(), and counts as a
  /// load. A thread holds no lease meanwhile. None if it is more than the limit.
  std::optional<Share> take(std::uint64_t bytes);
  /// Memory that is needed anyway. Pieces leave room for it where they can.
  Share note(std::uint64_t bytes);

  /// Whether a piece is in memory, with what is needed, and how often it has been asked for since
  /// it was loaded.
  bool isResident(std::size_t number, const PieceNeeds& needs = {}) const;
  int uses(std::size_t number) const;
  /// Counts a question to a piece; returns how many there were before, whether it is in memory or
  /// not.
  int countQuestion(std::size_t number);

  std::int64_t loads() const;  ///< how many pieces have been loaded so far
  std::uint64_t bytes() const; ///< of the pieces in memory

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

  void release(Lease& lease);
  void giveBack(Share& share);
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
  std::uint64_t Used = 0;  ///< by pieces in memory and those being loaded
  std::uint64_t Noted = 0; ///< by other things
  std::uint64_t Clock = 0;
  std::int64_t Loads = 0;
  int Active = 0; ///< leases, and loads that have their memory
};

} // namespace tipp

#endif
