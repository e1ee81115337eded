// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLazItems_h
#define tippLazItems_h

#include "Files/RawValues.h"
#include "Laz/IntegerCoder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <type_traits>

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

/// Codes the times of points, as the bits of doubles. They come from up to four interleaved
/// sequences, in each of which the difference of consecutive times is mostly the same. `HasSame`:
/// the models have a symbol for a time that equals the last one, as pointwise compression does.
template <bool HasSame>
class TimeCoder
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
    this->decodeSymbol(decoder);
    return this->decodeRest(decoder);
  }

  /// The same in two steps: the symbol that every time has, then what it needs.
  [[gnu::always_inline]] void decodeSymbol(RangeDecoder& decoder)
  {
    this->Symbol = int(this->Sequences[this->Current].Step == 0 ? decoder.symbol(this->AfterZero)
                                                                : decoder.symbol(this->Multiples));
  }
  bool decodeRest(RangeDecoder& decoder)
  {
    // An encoder changes the sequence once, since it then finds the time in the new one.
    constexpr int mostChanges = 4;
    for (int changes = 1;; ++changes)
    {
      Sequence& sequence = this->Sequences[this->Current];
      const int change = sequence.Step == 0 ? this->decodeAfterZero(decoder, sequence)
                                            : this->decodeMultiple(decoder, sequence);
      if (change == 0 || changes == mostChanges)
      {
        return change == 0;
      }
      this->Current = (this->Current + unsigned(change)) & 3U;
      this->decodeSymbol(decoder);
    }
  }

  std::uint64_t time() const { return this->Sequences[this->Current].Time; }

  void encode(RangeEncoder& encoder, std::uint64_t time)
  {
    static_assert(!HasSame, "pointwise compression is only read");
    if (!this->differenceTo(time, this->Current))
    {
      unsigned change = 1; // to the next sequence that the time may follow
      while (change < 4 && !this->differenceTo(time, (this->Current + change) & 3U))
      {
        ++change;
      }
      this->encodeChange(encoder, change & 3U);
      if (change == 4)
      {
        this->encodeStart(encoder, time);
        return;
      }
      this->Current = (this->Current + change) & 3U;
    }
    Sequence& sequence = this->Sequences[this->Current];
    const std::int32_t difference = *this->differenceTo(time, this->Current);
    if (sequence.Step == 0)
    {
      encoder.symbol(this->AfterZero, 0);
      this->Integers.encode(encoder, 0, difference, 0);
      sequence.Step = difference;
      sequence.Extremes = 0;
    }
    else
    {
      this->encodeMultiple(encoder, difference, sequence);
    }
    sequence.Time = time;
  }

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
    const int symbol = this->Symbol - int(same);
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
    int symbol = this->Symbol;
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
    const std::int32_t difference =
      this->Integers.decode(decoder, predictionOf(multiple, sequence), contextOf(multiple));
    countExtreme(multiple, difference, sequence);
    advance(sequence, difference);
  }

  /// The context of a difference that is about `multiple` times the usual one.
  static unsigned contextOf(int multiple)
  {
    return multiple == 0          ? 7
      : multiple == leastMultiple ? 6
      : multiple < 0              ? 5
      : multiple == mostMultiple  ? 4
      : multiple >= 10            ? 3
      : multiple > 1              ? 2
                                  : 1;
  }

  static std::int32_t predictionOf(int multiple, const Sequence& sequence)
  {
    return std::int32_t(std::uint32_t(multiple) * std::uint32_t(sequence.Step));
  }

  /// Changes the usual difference after some extreme multiples of it.
  static void countExtreme(int multiple, std::int32_t difference, Sequence& sequence)
  {
    const bool isExtreme = multiple == 0 || multiple == mostMultiple || multiple == leastMultiple;
    if (isExtreme && ++sequence.Extremes > 3)
    {
      sequence.Step = difference;
      sequence.Extremes = 0;
    }
  }

  /// Returns the difference to a sequence's last time; nullopt if it has more than 32 bits.
  std::optional<std::int32_t> differenceTo(std::uint64_t time, unsigned sequence) const
  {
    const auto difference = std::int64_t(time - this->Sequences[sequence].Time);
    const auto low = std::int32_t(difference);
    return low == difference ? std::make_optional(low) : std::nullopt;
  }

  /// Encodes that the time is of another sequence; 0: of a new one.
  void encodeChange(RangeEncoder& encoder, unsigned change)
  {
    if (this->Sequences[this->Current].Step == 0)
    {
      encoder.symbol(this->AfterZero, 1 + change);
    }
    else
    {
      encoder.symbol(this->Multiples, huge + change);
    }
  }

  void encodeStart(RangeEncoder& encoder, std::uint64_t time)
  {
    const std::uint64_t last = this->Sequences[this->Current].Time;
    this->Integers.encode(encoder, std::int32_t(last >> 32), std::int32_t(time >> 32), 8);
    encoder.bits(std::uint32_t(time), 32);
    this->beginSequence(time);
  }

  void encodeMultiple(RangeEncoder& encoder, std::int32_t difference, Sequence& sequence)
  {
    // In floats, as other encoders have it: the multiple is not part of the format.
    const float ratio = float(difference) / float(sequence.Step);
    const float rounded = ratio >= 0 ? ratio + 0.5F : ratio - 0.5F;
    const int multiple = int(std::clamp(rounded, float(leastMultiple), float(mostMultiple)));
    encoder.symbol(this->Multiples, unsigned(multiple >= 0 ? multiple : mostMultiple - multiple));
    this->Integers.encode(
      encoder, predictionOf(multiple, sequence), difference, contextOf(multiple));
    if (multiple == 1)
    {
      sequence.Extremes = 0;
    }
    countExtreme(multiple, difference, sequence);
  }

  void startSequence(RangeDecoder& decoder, const Sequence& from)
  {
    const auto high =
      std::uint32_t(this->Integers.decode(decoder, std::int32_t(from.Time >> 32), 8));
    const std::uint64_t low = decoder.bits(32);
    this->beginSequence((std::uint64_t(high) << 32) | low);
  }

  void beginSequence(std::uint64_t time)
  {
    this->Next = (this->Next + 1) & 3U;
    this->Sequences[this->Next] = { time, 0, 0 };
    this->Current = this->Next;
  }

  SymbolModel<huge + 4 + same> Multiples; ///< of times after a difference other than 0
  SymbolModel<5 + same> AfterZero;        ///< and after a difference of 0
  IntegerCoder<32, 9> Integers;
  std::array<Sequence, 4> Sequences;
  int Symbol = 0; ///< of decodeSymbol(), for decodeRest()
  unsigned Current = 0;
  unsigned Next = 0;
};

/// Codes red, green and blue, byte by byte: green's bytes are predicted by red's change, and blue's
/// by both.
class ColourCoder
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
    Step step = this->begin(decoder, colour);
    forBytes([&](auto number) { this->decodeByte<number>(decoder, step); });
    step.store(colour);
  }

  /// Does the same for two chunks, byte by byte in turn, see PointwiseChunk.
  static void decodeTwo(const std::array<ColourCoder*, 2>& coders,
    const std::array<RangeDecoder*, 2>& decoders, const std::array<std::uint16_t*, 2>& colours)
  {
    Step first = coders[0]->begin(*decoders[0], colours[0]);
    Step second = coders[1]->begin(*decoders[1], colours[1]);
    forBytes(
      [&](auto number)
      {
        coders[0]->decodeByte<number>(*decoders[0], first);
        coders[1]->decodeByte<number>(*decoders[1], second);
      });
    first.store(colours[0]);
    second.store(colours[1]);
  }

  /// Encodes the colour after `lastColour`.
  void encode(
    RangeEncoder& encoder, const std::uint16_t* lastColour, const std::uint16_t* nextColour)
  {
    const Colour last(lastColour);
    const Colour next(nextColour);
    const bool isGrey = nextColour[0] == nextColour[1] && nextColour[0] == nextColour[2];
    unsigned changes = isGrey ? 0 : isColoured;
    for (std::size_t i = 0; i < next.Bytes.size(); ++i)
    {
      changes |= unsigned(next.Bytes[i] != last.Bytes[i]) << i;
    }
    encoder.symbol(this->Changes, changes);
    forBytes(
      [&](auto number)
      {
        if (isCoded(number, changes))
        {
          const int difference = next.Bytes[number] - prediction(number, last, next);
          encoder.symbol(this->Bytes[number], unsigned(difference) & 255U);
        }
      });
  }

private:
  /// The low and the high bytes of red, green and blue.
  struct Colour
  {
    explicit Colour(const std::uint16_t* colour)
    {
      for (std::size_t i = 0; i < this->Bytes.size(); ++i)
      {
        this->Bytes[i] = (colour[i / 2] >> (8 * (i % 2))) & 255;
      }
    }

    void store(std::uint16_t* colour) const
    {
      // Stored at once: the processor cannot forward three stores to the load that copies them.
      std::uint64_t all = 0;
      for (std::size_t i = 0; i < 6; ++i)
      {
        all |= std::uint64_t(this->Bytes[i]) << (8 * i);
      }
      std::memcpy(colour, &all, this->Bytes.size());
    }

    std::array<int, 6> Bytes;
  };
  static constexpr unsigned isColoured = 64;

  /// A colour that is being decoded.
  struct Step
  {
    unsigned Changes;
    Colour Last;
    Colour Next;

    void store(std::uint16_t* colour)
    {
      if ((this->Changes & isColoured) == 0) // green and blue are as red
      {
        std::copy_n(this->Next.Bytes.begin(), 2, this->Next.Bytes.begin() + 2);
        std::copy_n(this->Next.Bytes.begin(), 2, this->Next.Bytes.begin() + 4);
      }
      this->Next.store(colour);
    }
  };

  [[gnu::always_inline]] Step begin(RangeDecoder& decoder, const std::uint16_t* colour)
  {
    return { decoder.symbol(this->Changes), Colour(colour), Colour(colour) };
  }

  template <std::size_t Number>
  [[gnu::always_inline]] void decodeByte(RangeDecoder& decoder, Step& step)
  {
    if (isCoded(Number, step.Changes))
    {
      const auto predicted = unsigned(prediction(Number, step.Last, step.Next));
      step.Next.Bytes[Number] = int((predicted + decoder.symbol(this->Bytes[Number])) & 255U);
    }
  }

  /// Calls code(number) for each byte in the order of the specification: after red, the low bytes
  /// of green and blue, then the high ones. `number` is a constant expression.
  template <typename Code>
  [[gnu::always_inline]] static void forBytes(const Code& code)
  {
    code(std::integral_constant<std::size_t, 0>());
    code(std::integral_constant<std::size_t, 1>());
    code(std::integral_constant<std::size_t, 2>());
    code(std::integral_constant<std::size_t, 4>());
    code(std::integral_constant<std::size_t, 3>());
    code(std::integral_constant<std::size_t, 5>());
  }

  /// Whether a byte differs from the last colour's, and is not known from red.
  [[gnu::always_inline]] static bool isCoded(std::size_t number, unsigned changes)
  {
    return (changes & (1U << number)) != 0 && (number < 2 || (changes & isColoured) != 0);
  }

  /// Predicts a byte of `next` from those before it.
  [[gnu::always_inline]] static int prediction(
    std::size_t number, const Colour& last, const Colour& next)
  {
    const std::size_t half = number % 2;
    int step = 0;
    if (number >= 2)
    {
      step = next.Bytes[half] - last.Bytes[half];
    }
    if (number >= 4)
    {
      step = (step + next.Bytes[2 + half] - last.Bytes[2 + half]) / 2;
    }
    return std::clamp(step + last.Bytes[number], 0, 255);
  }

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

  /// `packet` has the bytes of the packet before, and gets those of the next one.
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
  IntegerCoder<32, 1> Offsets;
  IntegerCoder<32, 1> Sizes;
  IntegerCoder<32, 1> Returns;
  IntegerCoder<32, 3> Directions;
  std::int32_t LastDifference = 0;
  unsigned LastKind = 0;
};

} // namespace tipp

#endif
