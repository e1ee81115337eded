// SPDX-License-Identifier: BSD-3-Clause
#include "Resident/ResidentPieces.h"

#include <algorithm>

namespace tipp
{

bool PieceNeeds::cover(const PieceNeeds& other) const
{
  for (std::size_t i = 0; i < other.Arrays.size(); ++i)
  {
    if (other.Arrays[i] && (i >= this->Arrays.size() || !this->Arrays[i]))
    {
      return false;
    }
  }
  return (this->Locator || !other.Locator) && (this->Topology || !other.Topology);
}

void PieceNeeds::add(const PieceNeeds& other)
{
  this->Arrays.resize(std::max(this->Arrays.size(), other.Arrays.size()));
  for (std::size_t i = 0; i < other.Arrays.size(); ++i)
  {
    this->Arrays[i] = this->Arrays[i] || other.Arrays[i];
  }
  this->Locator = this->Locator || other.Locator;
  this->Topology = this->Topology || other.Topology;
}

bool ResidentPieces::fit(std::size_t first, std::size_t end, const PieceNeeds& needs) const
{
  std::uint64_t bytes = 0;
  for (std::size_t number = first; number < end; ++number)
  {
    bytes += this->BytesOf(number, needs);
  }
  return bytes <= this->Limit;
}

ResidentPieces::Lease ResidentPieces::get(std::size_t number, const PieceNeeds& needs, bool stays)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  Slot& slot = this->Slots[number];
  this->Changed.wait(lock, [&slot] { return !slot.Loading; });
  slot.LastUse = ++this->Clock;
  if (!slot.Held.Part || !slot.Held.Has.cover(needs))
  {
    const PieceNeeds all = this->needsWithin(lock, number, needs, slot);
    slot.Loading = true;
    const std::uint64_t bytes = std::max(this->BytesOf(number, all), slot.Bytes);
    this->makeRoom(lock, slot, bytes);
    const ResidentPiece before = slot.Held;
    const std::uint64_t more = bytes - slot.Bytes;
    this->Used += more;
    ++this->Active;
    const auto finish = [&](std::uint64_t kept)
    {
      lock.lock();
      this->Used += kept;
      this->Used -= more;
      slot.Bytes += kept;
      slot.Loading = false;
      --this->Active;
      this->Changed.notify_all();
    };
    lock.unlock();
    try
    {
      ResidentPiece made = this->LoadPiece(number, all, before);
      made.Has = all;
      finish(more);
      this->Loads += before.Part ? 0 : 1;
      slot.Held = std::move(made);
    }
    catch (...)
    {
      finish(0);
      throw;
    }
  }
  slot.Stays = slot.Stays || stays;
  ++slot.Users;
  ++slot.Uses;
  ++this->Active;
  return { *this, number, slot.Held };
}

/// Returns what a piece has already together with `needs`. If both together exceed the limit, waits
/// until the piece is not in use, drops it, and returns only `needs`.
PieceNeeds ResidentPieces::needsWithin(
  std::unique_lock<std::mutex>& lock, std::size_t number, const PieceNeeds& needs, Slot& slot)
{
  PieceNeeds all = slot.Held.Has;
  all.add(needs);
  if (this->fits(number, all))
  {
    return all;
  }
  const std::uint64_t bytes = this->BytesOf(number, needs);
  if (bytes > this->Limit)
  {
    this->RefusePiece(number, bytes);
  }
  this->Changed.wait(lock, [&slot] { return !slot.Loading && slot.Users == 0; });
  this->drop(slot);
  return needs;
}

void ResidentPieces::release(std::size_t number)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  Slot& slot = this->Slots[number];
  --slot.Users;
  --this->Active;
  if (slot.Users == 0 && !slot.Stays && !slot.Loading)
  {
    this->drop(slot);
  }
  this->Changed.notify_all();
}

/// Drops the least recently used piece except `keep`. Returns false if none can be dropped.
bool ResidentPieces::dropOldest(const Slot& keep)
{
  Slot* oldest = nullptr;
  for (auto& [number, slot] : this->Slots)
  {
    if (&slot != &keep && slot.Held.Part && slot.Users == 0 && !slot.Loading &&
      (!oldest || slot.LastUse < oldest->LastUse))
    {
      oldest = &slot;
    }
  }
  if (oldest)
  {
    this->drop(*oldest);
  }
  return oldest != nullptr;
}

void ResidentPieces::drop(Slot& slot)
{
  this->Used -= slot.Bytes;
  slot.Held = {};
  slot.Bytes = 0;
  slot.Uses = 0;
  slot.Stays = false;
}

/// Drops other pieces, or waits, until there is space for `bytes` in this slot. `bytes` must be
/// within the limit.
void ResidentPieces::makeRoom(std::unique_lock<std::mutex>& lock, Slot& slot, std::uint64_t bytes)
{
  while (this->Used + this->Noted - slot.Bytes + bytes > this->Limit)
  {
    if (this->dropOldest(slot))
    {
      continue;
    }
    if (this->Active == 0 && slot.Held.Part)
    {
      // All other threads wait as well, for more memory for their own pieces.
      this->drop(slot);
      this->Changed.notify_all();
    }
    if (this->Active == 0 && this->Used - slot.Bytes + bytes <= this->Limit)
    {
      return; // memory of note() leaves no space, but some thread must continue
    }
    this->Changed.wait(lock);
  }
}

ResidentPieces::Share ResidentPieces::take(std::uint64_t bytes)
{
  if (bytes > this->Limit)
  {
    return nullptr;
  }
  std::unique_lock<std::mutex> lock(this->Mutex);
  Slot none;
  this->makeRoom(lock, none, bytes);
  this->Used += bytes;
  ++this->Active;
  ++this->Loads;
  return Share(this, { bytes, true });
}

ResidentPieces::Share ResidentPieces::note(std::uint64_t bytes)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Noted += bytes;
  return Share(this, { bytes, false });
}

void ResidentPieces::giveBack(const GiveBack& share)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  (share.IsActive ? this->Used : this->Noted) -= share.Bytes;
  this->Active -= share.IsActive ? 1 : 0;
  this->Changed.notify_all();
}

bool ResidentPieces::isResident(std::size_t number, const PieceNeeds& needs) const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto slot = this->Slots.find(number);
  return slot != this->Slots.end() && slot->second.Held.Part && slot->second.Held.Has.cover(needs);
}

int ResidentPieces::countQuestion(std::size_t number)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Slots[number].Questions++;
}

int ResidentPieces::uses(std::size_t number) const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto slot = this->Slots.find(number);
  return slot != this->Slots.end() ? slot->second.Uses : 0;
}

std::int64_t ResidentPieces::loads() const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Loads;
}

std::uint64_t ResidentPieces::bytes() const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Used;
}

} // namespace tipp
