// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLazItems_h
#define tippLazItems_h

#include "Files/RawValues.h"
#include "Laz/IntegerDecoder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

/// @file
/// The models that the pointwise and the layered compressors have in common.

namespace tipp
{

/// Models of 2^8 or fewer symbols for each of many contexts, of which a file uses few.
template <unsigned Capacity, std::size_t Contexts>
class ContextModels
{
public:
  void reset() { this->IsReady.fill(false); }

  SymbolModel<Capacity>& of(std::size_t context)
  {
    if (!this->IsReady[context])
    {
      this->prepare(context);
    }
    return *this->Models[context];
  }

private:
  [[gnu::noinline]] void prepare(std::size_t context)
  {
    if (!this->Models[context])
    {
      this->Models[context] = std::make_unique<SymbolModel<Capacity>>();
    }
    this->Models[context]->reset(Capacity);
    this->IsReady[context] = true;
  }

  std::array<bool, Contexts> IsReady{};
  std::array<std::unique_ptr<SymbolModel<Capacity>>, Contexts> Models;
};

/// An approximate median of the last values (LASzip's paper, section 5.2): of five sorted values,
/// a new one replaces the highest and the lowest in turn, as it is below or above the median.
class StreamingMedian
{
public:
  std::int32_t median() const { return this->Sorted[2]; }

  void add(std::int32_t value)
  {
    const std::int32_t middle = this->Sorted[2];
    // The four values that stay, to which the new one is added where it belongs. All without
    // branches, which no processor would predict.
    const std::int32_t* const kept = &this->Sorted[1U - this->DropsHighest];
    const std::int32_t a = kept[0];
    const std::int32_t b = kept[1];
    const std::int32_t c = kept[2];
    const std::int32_t d = kept[3];
    const auto low = [value](std::int32_t other) { return other < value ? other : value; };
    const auto high = [](std::int32_t x, std::int32_t y) { return x < y ? y : x; };
    this->DropsHighest =
      unsigned(value < middle) | ((1U - this->DropsHighest) & unsigned(value == middle));
    this->Sorted = { low(a), high(a, low(b)), high(b, low(c)), high(c, low(d)), high(d, value) };
  }

private:
  std::array<std::int32_t, 5> Sorted{};
  unsigned DropsHighest = 1; ///< 0: the lowest
};

/// Contexts of X, Y and Z by the widths of the corrections before them: even, and limited.
inline unsigned contextOfWidth(unsigned width, unsigned most)
{
  return std::min(width & ~1U, most);
}

/// Decodes the times of points, as the bits of doubles. They come from up to four interleaved
/// sequences, in each of which the difference of consecutive times is mostly the same. `HasSame`:
/// the models have a symbol for a time that equals the last one, as pointwise compression does.
template <bool HasSame>
class TimeDecoder
{
public:
  void reset(std::uint64_t first)
  {
    this->Multiples.reset(huge + 4 + same);
    this->AfterZero.reset(5 + same);
    this->Integers.reset();
    this->Sequences = {};
    this->Sequences[0].Time = first;
    this->Current = this->Next = 0;
  }

  /// Decodes the next time. Returns false if it is damaged.
  bool decode(RangeDecoder& decoder)
  {
    // An encoder changes the sequence once, since it then finds the time in the new one.
    constexpr int mostChanges = 4;
    for (int i = 0; i < mostChanges; ++i)
    {
      Sequence& sequence = this->Sequences[this->Current];
      const int change = sequence.Step == 0 ? this->decodeAfterZero(decoder, sequence)
                                            : this->decodeMultiple(decoder, sequence);
      if (change == 0)
      {
        return true;
      }
      this->Current = (this->Current + unsigned(change)) & 3U;
    }
    return false;
  }

  std::uint64_t time() const { return this->Sequences[this->Current].Time; }

private:
  struct Sequence
  {
    std::uint64_t Time = 0;
    std::int32_t Step = 0; ///< the usual difference
    int Extremes = 0;      ///< times in a row that no multiple of it fits
  };
  static constexpr unsigned same = HasSame ? 1 : 0;
  static constexpr int mostMultiple = 500;
  static constexpr int leastMultiple = -10;
  static constexpr int huge = 511; ///< symbol: 64 bits follow; those above change the sequence

  static void advance(Sequence& sequence, std::int32_t difference)
  {
    sequence.Time += std::uint64_t(std::int64_t(difference));
  }

  /// Returns by how many sequences to go on, if the time is of another one.
  int decodeAfterZero(RangeDecoder& decoder, Sequence& sequence)
  {
    const int symbol = int(decoder.symbol(this->AfterZero)) - int(same);
    if (symbol > 1)
    {
      return symbol - 1;
    }
    if (symbol == 1)
    {
      this->startSequence(decoder, sequence);
    }
    else if (symbol == 0)
    {
      sequence.Step = this->Integers.decode(decoder, 0, 0);
      advance(sequence, sequence.Step);
      sequence.Extremes = 0;
    }
    return 0;
  }

  int decodeMultiple(RangeDecoder& decoder, Sequence& sequence)
  {
    int symbol = int(decoder.symbol(this->Multiples));
    if (HasSame && symbol >= huge)
    {
      symbol = symbol == huge ? -1 : symbol - 1;
    }
    if (symbol > huge)
    {
      return symbol - huge;
    }
    if (symbol == huge)
    {
      this->startSequence(decoder, sequence);
    }
    else if (symbol == 1)
    {
      advance(sequence, this->Integers.decode(decoder, sequence.Step, 1));
      sequence.Extremes = 0;
    }
    else if (symbol >= 0)
    {
      this->decodeOther(decoder, symbol, sequence);
    }
    return 0;
  }

  void decodeOther(RangeDecoder& decoder, int symbol, Sequence& sequence)
  {
    const int multiple = symbol <= mostMultiple ? symbol : mostMultiple - symbol;
    const bool isExtreme = multiple == 0 || multiple == mostMultiple || multiple == leastMultiple;
    const unsigned context = multiple == 0 ? 7
      : multiple == leastMultiple          ? 6
      : multiple < 0                       ? 5
      : multiple == mostMultiple           ? 4
      : multiple >= 10                     ? 3
                                           : 2;
    const auto prediction = std::int32_t(std::uint32_t(multiple) * std::uint32_t(sequence.Step));
    const std::int32_t difference = this->Integers.decode(decoder, prediction, context);
    if (isExtreme && ++sequence.Extremes > 3)
    {
      sequence.Step = difference;
      sequence.Extremes = 0;
    }
    advance(sequence, difference);
  }

  void startSequence(RangeDecoder& decoder, const Sequence& from)
  {
    const auto high =
      std::uint32_t(this->Integers.decode(decoder, std::int32_t(from.Time >> 32), 8));
    const std::uint64_t low = decoder.bits(32);
    this->Next = (this->Next + 1) & 3U;
    this->Sequences[this->Next] = { (std::uint64_t(high) << 32) | low, 0, 0 };
    this->Current = this->Next;
  }

  SymbolModel<huge + 4 + same> Multiples; ///< of times after a difference other than 0
  SymbolModel<5 + same> AfterZero;        ///< and after a difference of 0
  IntegerDecoder<32, 9> Integers;
  std::array<Sequence, 4> Sequences;
  unsigned Current = 0;
  unsigned Next = 0;
};

/// Decodes red, green and blue, byte by byte: green's bytes are predicted by red's change, and
/// blue's by both.
class ColourDecoder
{
public:
  void reset()
  {
    this->Changes.reset(128);
    this->Bytes[0].reset(256);
    std::fill(this->Bytes.begin() + 1, this->Bytes.end(), this->Bytes[0]);
  }

  /// Replaces the last colour by the next one.
  void decode(RangeDecoder& decoder, std::uint16_t* colour)
  {
    const unsigned changes = decoder.symbol(this->Changes);
    std::array<std::array<int, 2>, 3> last;
    for (std::size_t c = 0; c < 3; ++c)
    {
      last[c] = { colour[c] & 255, colour[c] >> 8 };
    }
    std::array<std::array<int, 2>, 3> next = last;
    const auto decodeByte = [&](std::size_t c, std::size_t half, int prediction)
    {
      const std::size_t number = 2 * c + half;
      if (changes & (1U << number))
      {
        const auto corrected =
          unsigned(std::clamp(prediction, 0, 255)) + decoder.symbol(this->Bytes[number]);
        next[c][half] = int(corrected & 255U);
      }
    };
    decodeByte(0, 0, last[0][0]);
    decodeByte(0, 1, last[0][1]);
    if (changes & 64U)
    {
      // The order of the specification: the low bytes of green and blue, then the high ones.
      for (std::size_t half = 0; half < 2; ++half)
      {
        const int red = next[0][half] - last[0][half];
        decodeByte(1, half, red + last[1][half]);
        const int both = (red + next[1][half] - last[1][half]) / 2;
        decodeByte(2, half, both + last[2][half]);
      }
    }
    else // grey
    {
      next[1] = next[2] = next[0];
    }
    for (std::size_t c = 0; c < 3; ++c)
    {
      colour[c] = std::uint16_t(next[c][0] | (next[c][1] << 8));
    }
  }

private:
  SymbolModel<128> Changes;
  std::array<SymbolModel<256>, 6> Bytes;
};

/// Decodes what a point says of its wave packet: 29 bytes.
class WaveDecoder
{
public:
  void reset()
  {
    this->Index.reset(256);
    for (SymbolModel<4>& model : this->OffsetKinds)
    {
      model.reset(4);
    }
    this->Offsets.reset();
    this->Sizes.reset();
    this->Returns.reset();
    this->Directions.reset();
    this->LastDifference = 0;
    this->LastKind = 0;
  }

  /// Replaces the last packet's bytes by the next one's.
  void decode(RangeDecoder& decoder, std::uint8_t* packet)
  {
    packet[0] = std::uint8_t(decoder.symbol(this->Index));
    this->LastKind = decoder.symbol(this->OffsetKinds[this->LastKind]);
    auto offset = valueAt<std::uint64_t>(packet + 1);
    const auto size = valueAt<std::int32_t>(packet + 9);
    if (this->LastKind == 1)
    {
      offset += std::uint32_t(size);
    }
    else if (this->LastKind == 2)
    {
      this->LastDifference = this->Offsets.decode(decoder, this->LastDifference, 0);
      offset += std::uint64_t(std::int64_t(this->LastDifference));
    }
    else if (this->LastKind == 3)
    {
      const std::uint64_t low = decoder.bits(32);
      offset = (std::uint64_t(decoder.bits(32)) << 32) | low;
    }
    setValue(packet + 1, offset);
    setValue(packet + 9, this->Sizes.decode(decoder, size, 0));
    setValue(packet + 13, this->Returns.decode(decoder, valueAt<std::int32_t>(packet + 13), 0));
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      std::uint8_t* const at = packet + 17 + 4 * axis;
      setValue(at, this->Directions.decode(decoder, valueAt<std::int32_t>(at), axis));
    }
  }

private:
  SymbolModel<256> Index;
  std::array<SymbolModel<4>, 4> OffsetKinds; ///< by the last one
  IntegerDecoder<32, 1> Offsets;
  IntegerDecoder<32, 1> Sizes;
  IntegerDecoder<32, 1> Returns;
  IntegerDecoder<32, 3> Directions;
  std::int32_t LastDifference = 0;
  unsigned LastKind = 0;
};

} // namespace tipp

#endif
