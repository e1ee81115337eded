// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRangeEncoder_h
#define tippRangeEncoder_h

#include "Laz/SymbolModel.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tipp
{

/// Encodes what RangeDecoder decodes, with the same models.
class RangeEncoder
{
public:
  /// Starts with no bytes.
  void reset()
  {
    this->Size = 0;
    this->Base = 0;
    this->Length = 0xFFFFFFFF;
  }

  template <unsigned Capacity, bool MayBeBit>
  [[gnu::always_inline]] void symbol(SymbolModel<Capacity, MayBeBit>& model, unsigned symbol)
  {
    const std::uint32_t unit = this->Length >> model.precision();
    std::uint16_t* const limit = model.limitOf(symbol);
    const std::uint32_t begin = model.begin(limit, unit);
    this->narrow(begin, model.end(limit, unit, this->Length) - begin);
    model.count(limit);
  }

  /// Encodes 1 to 32 bits that have no model.
  void bits(std::uint32_t value, unsigned count)
  {
    constexpr unsigned most = 19; // as in RangeDecoder
    if (count > most)
    {
      this->fewBits(value & 0xFFFFU, 16);
      value >>= 16;
      count -= 16;
    }
    this->fewBits(value, count);
  }

  /// Writes what the decoder needs to decode the last symbol. No symbol may follow.
  void finish()
  {
    constexpr std::uint32_t least = 1U << 24; // the shortest interval
    const bool isLong = this->Length > 2 * least;
    this->narrow(isLong ? least : least / 2, isLong ? least / 2 : least / 512);
    // The decoder reads four bytes ahead.
    const std::size_t zeros = isLong ? 3 : 2;
    this->makeRoom();
    std::memset(&this->Bytes[this->Size], 0, zeros);
    this->Size += zeros;
  }

  const std::uint8_t* bytes() const { return this->Bytes.data(); }
  std::size_t size() const { return this->Size; }

private:
  void fewBits(std::uint32_t value, unsigned count)
  {
    const std::uint32_t unit = this->Length >> count;
    this->narrow(value * unit, unit);
  }

  /// Goes to the part of the interval from `begin` on.
  [[gnu::always_inline]] void narrow(std::uint32_t begin, std::uint32_t length)
  {
    this->Base += begin;
    if (__builtin_expect(this->Base < begin, 0))
    {
      this->carry();
    }
    this->Length = length;
    this->makeRoom();
    const unsigned shift = unsigned(__builtin_clz(this->Length)) & 24U;
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    const std::uint32_t four = this->Base;
#else
    const std::uint32_t four = __builtin_bswap32(this->Base);
#endif
    std::memcpy(&this->Bytes[this->Size], &four, sizeof four); // of which some stay
    this->Size += shift / 8;
    this->Base <<= shift;
    this->Length <<= shift;
  }

  /// Adds 1 to the number that the bytes are. It stays below 1, so there is a byte to add it to.
  [[gnu::noinline]] void carry()
  {
    for (std::size_t i = this->Size; ++this->Bytes[--i] == 0;)
    {
    }
  }

  [[gnu::always_inline]] void makeRoom()
  {
    if (__builtin_expect(this->Size + 4 > this->Bytes.size(), 0))
    {
      this->grow();
    }
  }

  [[gnu::noinline]] void grow()
  {
    this->Bytes.resize(2 * this->Bytes.size() + 1024);
  }

  std::vector<std::uint8_t> Bytes; ///< of which `Size` are written
  std::size_t Size = 0;
  std::uint32_t Base = 0; ///< where the interval begins, after the bytes
  std::uint32_t Length = 0xFFFFFFFF;
};

} // namespace tipp

#endif
