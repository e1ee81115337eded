// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceEnds_h
#define tippPieceEnds_h

#include "Arrays/Buffer.h"
#include "Constraints/Constraint.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The point ids that are ends of pieces, and the pieces that end at each.
class PieceEnds
{
public:
  PieceEnds(std::size_t points, const std::vector<ConstraintPiece>& pieces, int threads);

  /// A quick filter: false for most ids if there are few ends. Ids may be negative.
  bool mayHave(PointId id) const
  {
    return (this->Marks[std::size_t(id) / 64 % MarkWords] >> (std::size_t(id) % 64) & 1) != 0;
  }
  bool has(PointId id) const
  {
    return id >= 0 && this->mayHave(id) &&
      (this->Words[std::size_t(id) / 64].Bits >> (std::size_t(id) % 64) & 1) != 0;
  }

  /// The rank of an id among all ends. The id must be an end.
  std::size_t rank(PointId id) const;

  /// Calls visit(entry) for each piece that ends at the end with this rank. The entry is twice the
  /// index of the piece, plus 1 for its end B.
  template <typename Visit>
  void visit(std::size_t rank, const Visit& visit) const
  {
    for (std::int64_t i = this->Starts[rank]; i < this->Starts[rank + 1]; ++i)
    {
      visit(std::int64_t(this->Entries[std::size_t(i)] & this->EntryMask));
    }
  }

  ///@{
  /// Prefetches what has(), expectVisit() and visit() read. Negative ids are ignored.
  void expect(PointId id) const
  {
    id >= 0 ? __builtin_prefetch(&this->Words[std::size_t(id) / 64]) : void();
  }
  void expectEntries(std::size_t rank) const { __builtin_prefetch(&this->Starts[rank]); }
  void expectVisit(std::size_t rank) const
  {
    __builtin_prefetch(&this->Entries[std::size_t(this->Starts[rank])]);
  }
  ///@}

private:
  /// A bit for each of 64 ids: whether it is an end.
  struct Word
  {
    std::uint64_t Bits = 0;
    std::uint64_t Before = 0; ///< number of bits in all words before
  };

  template <typename IdOf>
  void makeIndex(const IdOf& idOf, int threads);

  static constexpr std::size_t MarkWords = 1024; ///< so few that they stay in the first-level cache

  std::array<std::uint64_t, MarkWords> Marks{}; ///< the union of all words, folded to this size
  std::vector<Word> Words;                      ///< by id / 64
  Uninitialised<std::int64_t> Starts;           ///< first entry of each end, by rank
  Uninitialised<std::uint64_t> Entries;         ///< sorted by id
  std::uint64_t EntryMask = ~std::uint64_t(0);  ///< of the bits of an entry; the others are its id
};

} // namespace tipp

#endif
