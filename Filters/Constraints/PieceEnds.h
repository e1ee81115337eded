// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceEnds_h
#define tippPieceEnds_h

#include "Constraints/Constraint.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The points that are ends of pieces, by id, and the pieces that end at each.
class PieceEnds
{
public:
  PieceEnds(std::size_t points, const std::vector<ConstraintPiece>& pieces, int threads);

  /// False for most ids if there are few ends: then the words need not be fetched. Id: may be
  /// negative.
  bool mayHave(PointId id) const
  {
    return (this->Marks[std::size_t(id) / 64 % MarkWords] >> (std::size_t(id) % 64) & 1) != 0;
  }
  bool has(PointId id) const
  {
    return id >= 0 && this->mayHave(id) &&
      (this->Words[std::size_t(id) / 64].Bits >> (std::size_t(id) % 64) & 1) != 0;
  }

  /// The position of an id, which must be an end, among all ends.
  std::size_t rank(PointId id) const;

  /// Calls visit(entry) for each piece that ends at the end of this rank: twice the piece's number
  /// for its end A, and one more for its end B.
  template <typename Visit>
  void visit(std::size_t rank, const Visit& visit) const
  {
    for (std::int64_t i = this->Starts[rank]; i < this->Starts[rank + 1]; ++i)
    {
      visit(this->Entries[std::size_t(i)]);
    }
  }

  ///@{
  /// Prefetches what has(), expectVisit() and visit() will read; negative ids are ignored.
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
  /// Of 64 ids.
  struct Word
  {
    std::uint64_t Bits = 0;
    std::uint64_t Before = 0; ///< the number of bits in the words before
  };

  static constexpr std::size_t MarkWords = 1024; ///< so few that they stay in the nearest cache

  std::array<std::uint64_t, MarkWords> Marks{}; ///< the bits of all words, one above the other
  std::vector<Word> Words;                      ///< by id
  std::vector<std::int64_t> Starts;             ///< by rank, and the end
  std::vector<std::int64_t> Entries;
};

} // namespace tipp

#endif
