// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRangeDecoder_h
#define tippRangeDecoder_h

#include "Laz/SymbolModel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tipp
{

/// Decodes the arithmetic code of the LAZ specification from bytes in memory. It never reads
/// outside of them: past the end it reads zeros, and isDamaged() tells.
class RangeDecoder
{
public:
  RangeDecoder() = default;

  RangeDecoder(const std::uint8_t* bytes, std::size_t size)
    : At(reinterpret_cast<std::uintptr_t>(bytes))
    , Begin(At)
    , End(At + size)
  {
    // An encoder never writes the highest value, which would break Value < Length.
    this->Value = std::min(this->next(), this->Length - 1);
    this->At += 4;
  }

  template <unsigned Capacity, bool MayBeBit>
  [[gnu::always_inline]] unsigned symbol(SymbolModel<Capacity, MayBeBit>& model)
  {
    const std::uint32_t unit = this->Length >> model.precision();
    return this->take(model, model.find(this->Value / unit), unit);
  }

  /// The same where the symbol is mostly `likely`, which must be one of the model: as the
  /// processor predicts that, it need not wait for the division and the search.
  template <unsigned Capacity, bool MayBeBit>
  [[gnu::always_inline]] unsigned symbol(SymbolModel<Capacity, MayBeBit>& model, unsigned likely)
  {
    const std::uint32_t unit = this->Length >> model.precision();
    std::uint16_t* const limit = model.limitOf(likely);
    const std::uint32_t below = model.begin(limit, unit);
    const std::uint32_t above = model.end(limit, unit, this->Length);
    if (this->Value - below < above - below)
    {
      this->renormalize(this->Value - below, above - below);
      model.count(limit);
      return likely;
    }
    return this->take(model, model.find(this->Value / unit), unit);
  }

  /// Decodes 1 to 32 bits that have no model.
  [[gnu::always_inline]] std::uint32_t bits(unsigned count)
  {
    constexpr unsigned most = 19; // at once, so that they are lower than Length
    if (count > most)
    {
      const std::uint32_t low = this->fewBits(16);
      return (this->fewBits(count - 16) << 16) | low;
    }
    return this->fewBits(count);
  }

  /// Whether bytes were missing, or were not written by an encoder.
  bool isDamaged() const { return this->At > this->End || this->Excess != 0; }
  /// The number of bytes read.
  std::size_t position() const { return this->At - this->Begin; }

private:
  [[gnu::always_inline]] std::uint32_t fewBits(unsigned count)
  {
    const std::uint32_t unit = this->Length >> count;
    const std::uint32_t bits = this->Value / unit;
    this->renormalize(this->Value - bits * unit, unit);
    this->Excess |= bits >> count;
    return bits & ((1U << count) - 1);
  }

  template <unsigned Capacity, bool MayBeBit>
  [[gnu::always_inline]] unsigned take(
    SymbolModel<Capacity, MayBeBit>& model, std::uint16_t* limit, std::uint32_t unit)
  {
    const std::uint32_t below = model.begin(limit, unit);
    const std::uint32_t above = model.end(limit, unit, this->Length);
    this->renormalize(this->Value - below, above - below);
    model.count(limit);
    return model.symbolOf(limit);
  }

  /// Sets Value and Length, after bytes are shifted in until Length has its highest byte.
  [[gnu::always_inline]] void renormalize(std::uint32_t value, std::uint32_t length)
  {
    const unsigned shift = unsigned(__builtin_clz(length)) & 24U;
    const std::uint64_t wide = (std::uint64_t(value) << 32) | this->next();
    this->Value = std::uint32_t((wide << shift) >> 32);
    this->Length = length << shift;
    this->At += shift / 8;
  }

  /// The next four bytes, the first one highest.
  [[gnu::always_inline]] std::uint32_t next() const
  {
    if (__builtin_expect(this->At + 4 <= this->End, 1))
    {
      std::uint32_t four;
      std::memcpy(&four, reinterpret_cast<const void*>(this->At), sizeof four);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
      return four;
#else
      return __builtin_bswap32(four);
#endif
    }
    return nextAtEnd(this->At, this->End);
  }

  // Static, since a decoder whose address is passed on could not stay in registers.
  [[gnu::noinline]] static std::uint32_t nextAtEnd(std::uintptr_t at, std::uintptr_t end)
  {
    std::uint32_t four = 0;
    for (std::uintptr_t i = at; i < at + 4; ++i)
    {
      four = (four << 8) | (i < end ? *reinterpret_cast<const std::uint8_t*>(i) : 0U);
    }
    return four;
  }

  // Addresses, because a damaged stream leads past the end, where no pointer may point.
  std::uintptr_t At = 0;
  std::uintptr_t Begin = 0;
  std::uintptr_t End = 0;
  std::uint32_t Value = 0;
  std::uint32_t Length = 0xFFFFFFFF;
  std::uint32_t Excess = 0; ///< bits that an encoder does not write
};

} // namespace tipp

#endif
