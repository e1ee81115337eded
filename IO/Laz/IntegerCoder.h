// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIntegerCoder_h
#define tippIntegerCoder_h

#include "Laz/RangeDecoder.h"
#include "Laz/RangeEncoder.h"

#include <array>
#include <cstdint>

namespace tipp
{

/// Codes integers of up to 32 bits that are predicted (LASzip's paper, section 5.1): first the
/// number k of bits of the correction, by a model of the context, then the correction, whose
/// highest eight bits have a model for each k.
template <unsigned Bits, unsigned Contexts>
class IntegerCoder
{
public:
  void reset()
  {
    this->Widths[0].reset(Bits + 1);
    std::fill(this->Widths.begin() + 1, this->Widths.end(), this->Widths[0]);
    this->Corrections[0].resetBit();
    for (unsigned k = 1; k <= modelled; ++k)
    {
      this->Corrections[k].reset(1U << k);
    }
    std::fill(this->Corrections.begin() + modelled + 1, this->Corrections.end(),
      this->Corrections[modelled]);
  }

  /// Returns the next integer, modulo 2^32.
  [[gnu::always_inline]] std::int32_t decode(
    RangeDecoder& decoder, std::int32_t prediction, unsigned context)
  {
    this->decodeWidth(decoder, context);
    return this->decodeCorrection(decoder, prediction);
  }

  /// The same in two steps.
  [[gnu::always_inline]] void decodeWidth(RangeDecoder& decoder, unsigned context)
  {
    this->Width = decoder.symbol(this->Widths[context]);
  }
  [[gnu::always_inline]] std::int32_t decodeCorrection(
    RangeDecoder& decoder, std::int32_t prediction)
  {
    return std::int32_t(std::uint32_t(prediction) + this->correction(decoder, this->Width));
  }

  /// Encodes an integer. Of fewer than 32 bits, prediction and value are compared modulo 2^Bits.
  [[gnu::always_inline]] void encode(
    RangeEncoder& encoder, std::int32_t prediction, std::int32_t value, unsigned context)
  {
    constexpr unsigned unused = 32 - Bits;
    const std::uint32_t difference = std::uint32_t(value) - std::uint32_t(prediction);
    const std::int32_t correction = std::int32_t(difference << unused) >> unused;
    // With k bits there are the corrections from -2^k + 1 to -2^(k-1), and from 2^(k-1) + 1 to 2^k.
    const std::uint32_t magnitude =
      correction <= 0 ? 0U - std::uint32_t(correction) : std::uint32_t(correction) - 1;
    this->Width = magnitude == 0 ? 0 : 32U - unsigned(__builtin_clz(magnitude));
    encoder.symbol(this->Widths[context], this->Width);
    this->encodeCorrection(encoder, std::uint32_t(correction), this->Width);
  }

  /// The number of bits of the last correction.
  unsigned width() const { return this->Width; }

private:
  static constexpr unsigned modelled = 8; ///< number of bits that have a model

  [[gnu::always_inline]] std::uint32_t correction(RangeDecoder& decoder, unsigned k)
  {
    if (k == 32)
    {
      return 0x80000000U;
    }
    std::uint32_t value = decoder.symbol(this->Corrections[k]);
    if (k > modelled)
    {
      value = (value << (k - modelled)) | decoder.bits(k - modelled);
    }
    // The higher half of the values is positive, and begins after 2^(k-1); the lower half is
    // negative, and ends before -2^(k-1). With k = 0 the value is the correction.
    const std::uint32_t isLow = (((value << 1) >> k) & 1U) ^ 1U;
    return value + 1 - (isLow << k);
  }

  [[gnu::always_inline]] void encodeCorrection(
    RangeEncoder& encoder, std::uint32_t correction, unsigned k)
  {
    if (k == 32) // of a single correction
    {
      return;
    }
    const bool isNegative = correction >> 31 != 0;
    const std::uint32_t value =
      k == 0 ? correction : correction - 1 + (isNegative ? std::uint32_t(1) << k : 0);
    const unsigned low = k > modelled ? k - modelled : 0;
    encoder.symbol(this->Corrections[k], value >> low);
    if (low > 0)
    {
      encoder.bits(value & ((std::uint32_t(1) << low) - 1), low);
    }
  }

  unsigned Width = 0;
  std::array<SymbolModel<Bits + 1>, Contexts> Widths;
  std::array<SymbolModel<1U << modelled, true>, (Bits < 32 ? Bits + 1 : 32)> Corrections;
};

} // namespace tipp

#endif
