// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceCache_h
#define tippPieceCache_h

#include "Partitioned/ReadPiece.h"

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// An LRU cache of the pieces of one mesh.
class PieceCache
{
public:
  /// Identifies what was read of a piece.
  struct Key
  {
    std::size_t Number;
    bool Borrowed;
    std::vector<bool> Wanted;
    int Step;

    bool operator==(const Key& other) const
    {
      return this->Number == other.Number && this->Borrowed == other.Borrowed &&
        this->Wanted == other.Wanted && this->Step == other.Step;
    }
  };

  /// Null if the piece is not cached.
  std::shared_ptr<const Piece> find(const Key& key)
  {
    const auto entry = std::find_if(
      this->Entries.begin(), this->Entries.end(), [&key](const Entry& e) { return e.What == key; });
    if (entry == this->Entries.end())
    {
      return nullptr;
    }
    this->Entries.splice(this->Entries.begin(), this->Entries, entry);
    return entry->Held;
  }
  void keep(const Key& key, std::shared_ptr<const Piece> piece)
  {
    this->Entries.push_front({ key, std::move(piece) });
  }
  /// Drops the least recently used pieces until `pieces` are left.
  void shrink(std::size_t pieces) { this->Entries.resize(std::min(pieces, this->Entries.size())); }
  void clear() { this->Entries.clear(); }

private:
  struct Entry
  {
    Key What;
    std::shared_ptr<const Piece> Held;
  };
  std::list<Entry> Entries; ///< the most recently used one first
};

} // namespace tipp

#endif
