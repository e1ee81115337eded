// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSymbolModel_h
#define tippSymbolModel_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tipp
{

/// Of `Count` ascending values at `ascending`, 8 or 16, returns the size in bytes of those that are
/// at most `value`, which must be lower than 2^16.
template <unsigned Count>
[[gnu::always_inline]] inline unsigned bytesAtMost(
  const std::uint16_t* ascending, std::uint32_t value)
{
  static_assert(Count == 8 || Count == 16, "one or two vectors are compared");
#ifdef __SSE2__
  const __m128i limit = _mm_set1_epi16(short(value));
  // SSE2 has no unsigned comparison: a saturated difference of 0 means at most.
  const auto atMost = [&](const std::uint16_t* eight)
  {
    const __m128i values = _mm_loadu_si128(reinterpret_cast<const __m128i*>(eight));
    return _mm_cmpeq_epi16(_mm_subs_epu16(values, limit), _mm_setzero_si128());
  };
  if constexpr (Count == 16)
  {
    const __m128i both = _mm_packs_epi16(atMost(ascending), atMost(ascending + 8));
    return 2 * unsigned(__builtin_ctz(~unsigned(_mm_movemask_epi8(both))));
  }
  return unsigned(__builtin_ctz(~unsigned(_mm_movemask_epi8(atMost(ascending)))));
#else
  unsigned bytes = 0;
  for (unsigned i = 0; i < Count; ++i)
  {
    bytes += ascending[i] <= value ? 2U : 0U;
  }
  return bytes;
#endif
}

/// The adaptive model of an alphabet of up to Capacity symbols, by A. Said, 'Introduction to
/// Arithmetic Coding: Theory and Practice', 2004. Probabilities are recomputed now and then, from
/// counts, at the times that the LAZ specification fixes. The model of a bit has a precision and
/// times of its own: only if MayBeBit can a model be one.
///
/// A symbol is found without a loop whose length the processor would mispredict. In a large
/// alphabet, a table gives a symbol from the highest bits, and one vector comparison of the next
/// eight limits gives the right one, except in long tails of rare symbols. In a small one, the
/// first 16 limits are compared, without waiting for a table or taking its room in the cache.
template <unsigned Capacity, bool MayBeBit = false>
class SymbolModel
{
public:
  /// Starts with `symbols` equally probable symbols, 2 to Capacity.
  void reset(unsigned symbols)
  {
    this->Symbols = symbols;
    this->Precision = symbolPrecision;
    this->Numbers.fill(0xFFFF);
    std::fill_n(this->Numbers.begin() + CountsAt, symbols, std::uint16_t(1));
    this->Total = 0;
    this->Cycle = symbols;
    this->update();
    this->Cycle = this->Left = (symbols + 6) / 2;
  }

  /// Starts as the model of a bit.
  void resetBit()
  {
    static_assert(MayBeBit, "the precision of other models is a constant");
    this->reset(2);
    this->Precision = bitPrecision;
    this->Total = 2;
    this->Numbers[1] = 1U << (bitPrecision - 1);
    this->Cycle = this->Left = 4;
  }

  /// A limit is a probability times 2 to this power.
  unsigned precision() const { return MayBeBit ? this->Precision : symbolPrecision; }

  /// Returns the lower limit of the symbol whose interval holds `target`. The upper one follows it,
  /// so both are loaded without waiting for the symbol to be computed.
  [[gnu::always_inline]] std::uint16_t* find(std::uint32_t target)
  {
    std::uint16_t* limit = this->Numbers.data();
    if constexpr (HasTable)
    {
      limit += this->First[target >> BucketShift];
    }
    unsigned bytes = 0;
    do
    {
      bytes = bytesAtMost<Compared>(limit + 1, target);
      limit = reinterpret_cast<std::uint16_t*>(reinterpret_cast<char*>(limit) + bytes);
    } while (bytes == 2 * Compared); // the limits end with 0xFFFF, which no target reaches
    return limit;
  }

  /// The symbol of a lower limit, and the lower limit of a symbol.
  unsigned symbolOf(const std::uint16_t* limit) const
  {
    return unsigned(limit - this->Numbers.data());
  }
  std::uint16_t* limitOf(unsigned symbol) { return this->Numbers.data() + symbol; }

  /// Where a symbol's interval begins in one whose units are `unit` long.
  [[gnu::always_inline]] static std::uint32_t begin(const std::uint16_t* limit, std::uint32_t unit)
  {
    return *limit * unit;
  }

  /// Where it ends in one of this length. The last symbol, whose upper limit is 0xFFFF, has all
  /// that is left, which is a little more than its probability.
  [[gnu::always_inline]] static std::uint32_t end(
    const std::uint16_t* limit, std::uint32_t unit, std::uint32_t length)
  {
    return std::uint32_t(std::min<std::uint64_t>(std::uint64_t(limit[1]) * unit, length));
  }

  /// Counts the symbol of a lower limit.
  [[gnu::always_inline]] void count(std::uint16_t* limit)
  {
    ++limit[CountsAt];
    if (__builtin_expect(--this->Left == 0, 0))
    {
      this->update();
    }
  }

private:
  static constexpr unsigned symbolPrecision = 15;
  static constexpr unsigned bitPrecision = 13;
  static constexpr bool HasTable = Capacity > 33;
  static constexpr unsigned Compared = HasTable || Capacity <= 8 ? 8 : 16; ///< limits at once
  static constexpr unsigned CountsAt = Capacity + Compared; ///< after limits and padding
  static constexpr unsigned BucketBits = Capacity >= 64 ? 6 : 5;
  static constexpr unsigned BucketShift = symbolPrecision - BucketBits;
  /// Targets are up to 32831, because a length is rounded down before it is divided.
  static constexpr unsigned Buckets = (1U << BucketBits) + 1;
  using Index = std::conditional_t<(Capacity > 256), std::uint16_t, std::uint8_t>;

  [[gnu::noinline]] void update()
  {
    if (MayBeBit && this->Precision == bitPrecision)
    {
      this->updateBit();
      return;
    }
    constexpr std::uint32_t mostTotal = 1U << symbolPrecision;
    const unsigned symbols = this->Symbols;
    std::uint16_t* const counts = this->Numbers.data() + CountsAt;
    this->Total += this->Cycle;
    if (this->Total > mostTotal)
    {
      this->Total = 0;
      for (unsigned i = 0; i < symbols; ++i)
      {
        counts[i] = std::uint16_t((counts[i] + 1U) / 2);
        this->Total += counts[i];
      }
    }
    const std::uint32_t scale = 0x80000000U / this->Total;
    std::uint32_t sum = 0;
    for (unsigned i = 0; i < symbols; ++i)
    {
      this->Numbers[i] = std::uint16_t((scale * sum) >> 16);
      sum += counts[i];
    }
    if constexpr (HasTable)
    {
      this->fillTable();
    }
    this->Cycle = std::min(this->Cycle * 5 / 4, (symbols + 6) * 8);
    this->Left = this->Cycle;
  }

  void updateBit()
  {
    std::uint32_t zeros = this->Numbers[CountsAt];
    this->Total += this->Cycle;
    if (this->Total > 1U << bitPrecision)
    {
      this->Total = (this->Total + 1) / 2;
      zeros = (zeros + 1) / 2;
      this->Total += zeros == this->Total ? 1 : 0;
      this->Numbers[CountsAt] = std::uint16_t(zeros);
    }
    const std::uint32_t scale = 0x80000000U / this->Total;
    this->Numbers[1] = std::uint16_t((zeros * scale) >> (31 - bitPrecision));
    this->Cycle = std::min(this->Cycle * 5 / 4, 64U);
    this->Left = this->Cycle;
  }

  /// Sets each bucket's symbol to the last one whose interval begins in a lower bucket.
  void fillTable()
  {
    this->First.fill(0);
    for (unsigned i = 0; i < this->Symbols; ++i)
    {
      this->First[this->Numbers[i] >> BucketShift] = Index(i);
    }
    Index before = 0;
    for (Index& first : this->First)
    {
      const Index last = first;
      first = before;
      before = std::max(before, last);
    }
  }

  std::uint32_t Left = 0;  ///< symbols until the next update
  std::uint32_t Cycle = 0; ///< symbols between updates
  std::uint32_t Total = 0; ///< sum of the counts at the last update
  std::uint32_t Symbols = 0;
  std::uint32_t Precision = symbolPrecision;
  std::array<Index, HasTable ? Buckets : 1> First;
  /// The lower limits, then 0xFFFF up to the counts: one array, in which a limit's address leads to
  /// the count.
  std::array<std::uint16_t, CountsAt + Capacity> Numbers;
};

} // namespace tipp

#endif
