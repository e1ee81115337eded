// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/PieceCache.h"

#include <utility>

namespace tipp
{

std::shared_ptr<const Piece> PieceCache::find(const Key& key)
{
  for (auto entry = this->Entries.begin(); entry != this->Entries.end(); ++entry)
  {
    if (entry->What == key)
    {
      this->Entries.splice(this->Entries.begin(), this->Entries, entry);
      return entry->Held;
    }
  }
  return nullptr;
}

void PieceCache::keep(const Key& key, std::shared_ptr<const Piece> piece)
{
  this->Entries.push_front({ key, std::move(piece) });
}

void PieceCache::shrink(std::size_t pieces)
{
  while (this->Entries.size() > pieces)
  {
    this->Entries.pop_back();
  }
}

} // namespace tipp
