// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSymbolModel_h
#define tippSymbolModel_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tipp
{

/// Returns how many of the eight ascending values at `ascending` are at most `value`, which must be
/// lower than 2^16.
[[gnu::always_inline]] inline unsigned countAtMost(
  const std::uint16_t* ascending, std::uint32_t value)
{
#ifdef __SSE2__
  const __m128i values = _mm_loadu_si128(reinterpret_cast<const __m128i*>(ascending));
  const __m128i limit = _mm_set1_epi16(short(value));
  // SSE2 has no unsigned comparison: a saturated difference of 0 means at most.
  const __m128i atMost = _mm_cmpeq_epi16(_mm_subs_epu16(values, limit), _mm_setzero_si128());
  return unsigned(__builtin_ctz(~unsigned(_mm_movemask_epi8(atMost)))) / 2;
#else
  unsigned count = 0;
  for (int i = 0; i < 8; ++i)
  {
    count += ascending[i] <= value ? 1U : 0U;
  }
  return count;
#endif
}

/// The adaptive model of an alphabet of up to Capacity symbols, by A. Said, 'Introduction to
/// Arithmetic Coding: Theory and Practice', 2004. Probabilities are recomputed now and then, from
/// counts, at the times that the LAZ specification fixes. The model of a bit has a precision and
/// times of its own.
///
/// A symbol is found without a loop whose length the processor would mispredict: a table gives a
/// symbol from the highest bits, and one vector comparison of the next eight limits gives the
/// right one, except in long tails of rare symbols.
template <unsigned Capacity>
class SymbolModel
{
public:
  /// Starts with `symbols` equally probable symbols, 2 to Capacity.
  void reset(unsigned symbols)
  {
    this->Symbols = symbols;
    this->Precision = symbolPrecision;
    std::fill(this->Limits.begin(), this->Limits.end(), std::uint16_t(0xFFFF));
    std::fill_n(this->Counts.begin(), symbols, std::uint16_t(1));
    this->Total = 0;
    this->Cycle = symbols;
    this->update();
    this->Cycle = this->Left = (symbols + 6) / 2;
  }

  /// Starts as the model of a bit.
  void resetBit()
  {
    static_assert(Capacity > 16, "the updates of small alphabets are kept simple");
    this->reset(2);
    this->Precision = bitPrecision;
    this->Total = 2;
    this->Limits[1] = 1U << (bitPrecision - 1);
    this->Cycle = this->Left = 4;
  }

  /// A limit is a probability times 2 to this power.
  unsigned precision() const { return Capacity > 16 ? this->Precision : symbolPrecision; }

  /// Returns the symbol whose interval holds `target`.
  [[gnu::always_inline]] unsigned find(std::uint32_t target) const
  {
    unsigned symbol = 0;
    if constexpr (HasTable)
    {
      symbol = this->First[target >> BucketShift];
    }
    unsigned more = 0;
    do
    {
      more = countAtMost(&this->Limits[symbol + 1], target);
      symbol += more;
    } while (more == 8); // the limits end with 0xFFFF, which no target reaches
    return symbol;
  }

  /// The lower limit of the symbol's interval; that after the last symbol is 0xFFFF.
  std::uint64_t limit(unsigned symbol) const { return this->Limits[symbol]; }

  /// Where the symbol's interval ends in one of this length, whose units are `unit` long. The last
  /// symbol has all that is left, which is a little more than its probability.
  [[gnu::always_inline]] std::uint32_t end(
    unsigned symbol, std::uint32_t unit, std::uint32_t length) const
  {
    return std::uint32_t(std::min<std::uint64_t>(this->limit(symbol + 1) * unit, length));
  }

  [[gnu::always_inline]] void count(unsigned symbol)
  {
    ++this->Counts[symbol];
    if (--this->Left == 0)
    {
      this->update();
    }
  }

private:
  static constexpr unsigned symbolPrecision = 15;
  static constexpr unsigned bitPrecision = 13;
  static constexpr bool HasTable = Capacity > 16;
  static constexpr unsigned BucketBits = Capacity > 64 ? 6 : 5;
  static constexpr unsigned BucketShift = symbolPrecision - BucketBits;
  /// Targets are up to 32831, because a length is rounded down before it is divided.
  static constexpr unsigned Buckets = (1U << BucketBits) + 1;
  using Index = std::conditional_t<(Capacity > 256), std::uint16_t, std::uint8_t>;

  [[gnu::noinline]] void update()
  {
    if (Capacity > 16 && this->Precision == bitPrecision)
    {
      this->updateBit();
      return;
    }
    constexpr std::uint32_t mostTotal = 1U << symbolPrecision;
    const unsigned symbols = this->Symbols;
    this->Total += this->Cycle;
    if (this->Total > mostTotal)
    {
      this->Total = 0;
      for (unsigned i = 0; i < symbols; ++i)
      {
        this->Counts[i] = std::uint16_t((this->Counts[i] + 1U) / 2);
        this->Total += this->Counts[i];
      }
    }
    const std::uint32_t scale = 0x80000000U / this->Total;
    std::uint32_t sum = 0;
    for (unsigned i = 0; i < symbols; ++i)
    {
      this->Limits[i] = std::uint16_t((scale * sum) >> 16);
      sum += this->Counts[i];
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
    std::uint32_t zeros = this->Counts[0];
    this->Total += this->Cycle;
    if (this->Total > 1U << bitPrecision)
    {
      this->Total = (this->Total + 1) / 2;
      zeros = (zeros + 1) / 2;
      this->Total += zeros == this->Total ? 1 : 0;
      this->Counts[0] = std::uint16_t(zeros);
    }
    const std::uint32_t scale = 0x80000000U / this->Total;
    this->Limits[1] = std::uint16_t((zeros * scale) >> (31 - bitPrecision));
    this->Cycle = std::min(this->Cycle * 5 / 4, 64U);
    this->Left = this->Cycle;
  }

  /// Sets each bucket's symbol to the last one whose interval begins in a lower bucket.
  void fillTable()
  {
    this->First.fill(0);
    for (unsigned i = 0; i < this->Symbols; ++i)
    {
      this->First[this->Limits[i] >> BucketShift] = Index(i);
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
  std::array<std::uint16_t, Capacity + 8> Limits; ///< lower limits, then 0xFFFF
  std::array<std::uint16_t, Capacity> Counts;
};

} // namespace tipp

#endif
