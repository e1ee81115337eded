// SPDX-License-Identifier: BSD-3-Clause
#include "Laz/LazChunk.h"
#include "Laz/LazItems.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace tipp
{
namespace
{

/// Returns the context of a point's return number and number of returns, both 0 to 7: each pair of
/// up to five returns has one (LAZ specification, POINT10 version 2).
constexpr unsigned context10(unsigned number, unsigned count)
{
  const unsigned low = number < count ? number : count;
  const unsigned high = number < count ? count : number;
  return low == 0 ? 15 - high
    : high <= 5   ? high * (high - 1) / 2 + low - 1
    : high == 6   ? low + 9
                  : low + 8;
}

/// Contexts by the lowest six bits of the byte of returns.
struct ReturnContexts10
{
  std::array<std::uint8_t, 64> Pair{};  ///< 16 contexts
  std::array<std::uint8_t, 64> Level{}; ///< 8 contexts: returns after this one

  constexpr ReturnContexts10()
  {
    for (unsigned bits = 0; bits < 64; ++bits)
    {
      const unsigned number = bits & 7U;
      const unsigned count = bits >> 3;
      this->Pair[bits] = std::uint8_t(context10(number, count));
      this->Level[bits] = std::uint8_t(number < count ? count - number : number - count);
    }
  }
};
constexpr ReturnContexts10 contexts10;

/// Decodes the 20 bytes that points of all formats 0 to 5 begin with.
class Point10Decoder
{
public:
  void reset(const std::uint8_t* first)
  {
    std::memcpy(this->Last.data(), first, this->Last.size());
    this->MedianX = {};
    this->MedianY = {};
    this->LastIntensity = {};
    this->LastZ = {};
    this->Changes.reset(64);
    this->Returns.reset();
    this->Classes.reset();
    this->UserData.reset();
    this->Angles[0].reset(256);
    this->Angles[1] = this->Angles[0];
    this->Intensities.reset();
    this->Sources.reset();
    this->X.reset();
    this->Y.reset();
    this->Z.reset();
  }

  /// The steps of a point, in their order, each of about one symbol.
  [[gnu::always_inline]] void decodeChanges(RangeDecoder& decoder)
  {
    this->Changed = decoder.symbol(this->Changes);
  }

  [[gnu::always_inline]] void decodeReturns(RangeDecoder& decoder)
  {
    std::uint8_t& last = this->Last[14];
    if (this->Changed & 32U)
    {
      last = std::uint8_t(decoder.symbol(this->Returns.of(last)));
    }
    const unsigned returns = last & 63U;
    this->Pair = contexts10.Pair[returns];
    this->Single = returns >> 3 == 1 ? 1 : 0;
  }

  [[gnu::always_inline]] void decodeWidthOfIntensity(RangeDecoder& decoder)
  {
    if (this->Changed & 16U)
    {
      this->Intensities.decodeWidth(decoder, std::min(this->Pair, 3U));
    }
  }

  [[gnu::always_inline]] void decodeIntensity(RangeDecoder& decoder)
  {
    std::uint16_t& intensity = this->LastIntensity[this->Pair];
    if (this->Changed & 16U)
    {
      intensity = std::uint16_t(this->Intensities.decodeCorrection(decoder, intensity));
    }
    setValue(&this->Last[12], intensity);
  }

  [[gnu::always_inline]] void decodeOthers(RangeDecoder& decoder)
  {
    if (this->Changed & 15U)
    {
      this->decodeChangedOthers(decoder);
    }
  }

  [[gnu::always_inline]] void decodeWidthX(RangeDecoder& decoder)
  {
    this->X.decodeWidth(decoder, this->Single);
  }

  [[gnu::always_inline]] void decodeX(RangeDecoder& decoder)
  {
    StreamingMedian& median = this->MedianX[this->Pair];
    const std::int32_t step = this->X.decodeCorrection(decoder, median.median());
    median.add(step);
    this->add(0, step);
  }

  [[gnu::always_inline]] void decodeWidthY(RangeDecoder& decoder)
  {
    this->Y.decodeWidth(decoder, this->Single + contextOfWidth(this->X.width(), 20));
  }

  [[gnu::always_inline]] void decodeY(RangeDecoder& decoder)
  {
    StreamingMedian& median = this->MedianY[this->Pair];
    const std::int32_t step = this->Y.decodeCorrection(decoder, median.median());
    median.add(step);
    this->add(4, step);
  }

  [[gnu::always_inline]] void decodeWidthZ(RangeDecoder& decoder)
  {
    const unsigned width = (this->X.width() + this->Y.width()) / 2;
    this->Z.decodeWidth(decoder, this->Single + contextOfWidth(width, 18));
  }

  [[gnu::always_inline]] void decodeZ(RangeDecoder& decoder)
  {
    std::int32_t& z = this->LastZ[contexts10.Level[this->Last[14] & 63U]];
    z = this->Z.decodeCorrection(decoder, z);
    setValue(&this->Last[8], z);
  }

  void store(std::uint8_t* record) const
  {
    std::memcpy(record, this->Last.data(), this->Last.size());
  }

private:
  void decodeChangedOthers(RangeDecoder& decoder)
  {
    const unsigned changes = this->Changed;
    std::uint8_t* const last = this->Last.data();
    if (changes & 8U)
    {
      last[15] = std::uint8_t(decoder.symbol(this->Classes.of(last[15])));
    }
    if (changes & 4U)
    {
      const unsigned direction = (last[14] >> 6) & 1U;
      last[16] = std::uint8_t(last[16] + decoder.symbol(this->Angles[direction]));
    }
    if (changes & 2U)
    {
      last[17] = std::uint8_t(decoder.symbol(this->UserData.of(last[17])));
    }
    if (changes & 1U)
    {
      const auto source = valueAt<std::uint16_t>(last + 18);
      setValue(last + 18, std::uint16_t(this->Sources.decode(decoder, source, 0)));
    }
  }

  void add(std::size_t at, std::int32_t step)
  {
    setValue(&this->Last[at], valueAt<std::uint32_t>(&this->Last[at]) + std::uint32_t(step));
  }

  unsigned Changed = 0; ///< attributes that differ from the last point's, as bits
  unsigned Pair = 0;    ///< context of the point's returns
  unsigned Single = 0;  ///< 1: it is the only one
  std::array<std::uint8_t, 20> Last{};
  std::array<StreamingMedian, 16> MedianX;
  std::array<StreamingMedian, 16> MedianY;
  std::array<std::uint16_t, 16> LastIntensity{};
  std::array<std::int32_t, 8> LastZ{};
  SymbolModel<64> Changes;
  ContextModels<256, 256> Returns;
  ContextModels<256, 256> Classes;
  ContextModels<256, 256> UserData;
  std::array<SymbolModel<256>, 2> Angles;
  IntegerCoder<16, 4> Intensities;
  IntegerCoder<16, 1> Sources;
  IntegerCoder<32, 2> X;
  IntegerCoder<32, 22> Y;
  IntegerCoder<32, 20> Z;
};

/// An item and its models, of which only those of its kind are there.
struct PointwiseItem
{
  LazItem Item;
  std::unique_ptr<Point10Decoder> Point;
  std::unique_ptr<TimeCoder<true>> Time;
  std::unique_ptr<ColourCoder> Colour;
  std::unique_ptr<WaveDecoder> Wave;
  std::vector<SymbolModel<256>> Bytes;
  std::vector<std::uint8_t> Last; ///< the item's bytes in the last point
};

/// Decodes points of formats 0 to 5, whose items follow each other in one stream of bytes.
class PointwiseChunk : public LazChunkDecoder
{
public:
  explicit PointwiseChunk(const LazFormat& format)
    : LazChunkDecoder(format.RecordLength)
  {
    for (const LazItem& description : format.Items)
    {
      PointwiseItem& item = this->Items.emplace_back();
      item.Item = description;
      item.Last.resize(description.Size);
      switch (description.What)
      {
        case LazItem::Kind::Point10:
          item.Point = std::make_unique<Point10Decoder>();
          break;
        case LazItem::Kind::Time11:
          item.Time = std::make_unique<TimeCoder<true>>();
          break;
        case LazItem::Kind::Colour12:
          item.Colour = std::make_unique<ColourCoder>();
          break;
        case LazItem::Kind::Wave13:
          item.Wave = std::make_unique<WaveDecoder>();
          break;
        default:
          item.Bytes.resize(description.Size);
          break;
      }
    }
  }

  std::size_t position() const override
  {
    constexpr std::size_t fewest = 4; // of a stream without symbols
    return this->RecordLength + (this->IsStarted ? this->Decoder.position() : fewest);
  }

private:
  void open(std::size_t size) override { this->Size = size; }

  void decode(std::size_t count, std::uint8_t* records) override
  {
    std::array<Stream, 1> streams = { Stream(*this, records) };
    decodeStreams(streams, count);
  }

  void decodeWith(LazChunkDecoder& decoder, std::size_t count, std::uint8_t* records,
    std::uint8_t* otherRecords) override
  {
    std::array<Stream, 2> streams = { Stream(*this, records),
      Stream(static_cast<PointwiseChunk&>(decoder), otherRecords) };
    decodeStreams(streams, count);
  }

  /// The state of a chunk while some of its points are decoded, as in LayeredChunk: steps of two
  /// chunks in turn take less time than one chunk after the other.
  struct Stream
  {
    Stream(PointwiseChunk& chunk, std::uint8_t* record)
      : Chunk(chunk)
      , Decoder(chunk.Decoder)
      , Record(record)
    {
    }

    PointwiseChunk& Chunk;
    RangeDecoder Decoder;
    std::uint8_t* Record;
    bool IsGood = true;
  };

  template <std::size_t Count>
  static void decodeStreams(std::array<Stream, Count>& streams, std::size_t points)
  {
    const std::size_t items = streams.front().Chunk.Items.size();
    bool isGood = true;
    for (; points > 0 && isGood; --points)
    {
      for (std::size_t item = 0; item < items; ++item)
      {
        decodeItem(streams, item);
      }
      for (Stream& stream : streams)
      {
        isGood = isGood && stream.IsGood && !stream.Decoder.isDamaged();
        stream.Record += stream.Chunk.RecordLength;
      }
    }
    for (Stream& stream : streams)
    {
      stream.Chunk.Decoder = stream.Decoder;
    }
    if (!isGood)
    {
      throw LazError("has damaged compressed points");
    }
  }

  template <std::size_t Count>
  [[gnu::always_inline]] static void decodeItem(
    std::array<Stream, Count>& streams, std::size_t number)
  {
    const LazItem::Kind what = streams.front().Chunk.Items[number].Item.What;
    if (what == LazItem::Kind::Point10)
    {
      decodePoints(streams, number);
      return;
    }
    if constexpr (Count > 1)
    {
      if (what == LazItem::Kind::Time11)
      {
        decodeTwoTimes(streams, number);
        return;
      }
      if (what == LazItem::Kind::Colour12)
      {
        decodeTwoColours(streams, number);
        return;
      }
    }
    for (Stream& stream : streams)
    {
      PointwiseItem& item = stream.Chunk.Items[number];
      stream.IsGood =
        decodeItem(stream.Decoder, item, stream.Record + item.Item.Offset) && stream.IsGood;
    }
  }

  template <std::size_t Count>
  [[gnu::always_inline]] static void decodePoints(
    std::array<Stream, Count>& streams, std::size_t number)
  {
    using Point = Point10Decoder;
    std::array<Point*, Count> points;
    for (std::size_t i = 0; i < Count; ++i)
    {
      points[i] = streams[i].Chunk.Items[number].Point.get();
    }
    const auto each = [&](const auto& step)
    {
      step(*points[0], streams[0].Decoder);
      if constexpr (Count > 1)
      {
        step(*points[1], streams[1].Decoder);
      }
    };
    each([](Point& p, RangeDecoder& decoder) { p.decodeChanges(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeReturns(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeWidthOfIntensity(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeIntensity(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeOthers(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeWidthX(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeX(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeWidthY(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeY(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeWidthZ(decoder); });
    each([](Point& p, RangeDecoder& decoder) { p.decodeZ(decoder); });
    for (std::size_t i = 0; i < Count; ++i)
    {
      points[i]->store(streams[i].Record + streams[i].Chunk.Items[number].Item.Offset);
    }
  }

  [[gnu::always_inline]] static void decodeTwoTimes(
    std::array<Stream, 2>& streams, std::size_t number)
  {
    for (Stream& stream : streams)
    {
      stream.Chunk.Items[number].Time->decodeSymbol(stream.Decoder);
    }
    for (Stream& stream : streams)
    {
      PointwiseItem& item = stream.Chunk.Items[number];
      stream.IsGood = item.Time->decodeRest(stream.Decoder) && stream.IsGood;
      setValue(stream.Record + item.Item.Offset, item.Time->time());
    }
  }

  [[gnu::always_inline]] static void decodeTwoColours(
    std::array<Stream, 2>& streams, std::size_t number)
  {
    const std::array<PointwiseItem*, 2> items = { &streams[0].Chunk.Items[number],
      &streams[1].Chunk.Items[number] };
    std::array<std::array<std::uint16_t, 3>, 2> colours;
    for (std::size_t i = 0; i < 2; ++i)
    {
      std::memcpy(colours[i].data(), items[i]->Last.data(), sizeof colours[i]);
    }
    ColourCoder::decodeTwo({ items[0]->Colour.get(), items[1]->Colour.get() },
      { &streams[0].Decoder, &streams[1].Decoder }, { colours[0].data(), colours[1].data() });
    for (std::size_t i = 0; i < 2; ++i)
    {
      std::memcpy(items[i]->Last.data(), colours[i].data(), sizeof colours[i]);
      std::memcpy(streams[i].Record + items[i]->Item.Offset, colours[i].data(), sizeof colours[i]);
    }
  }

  void start() override
  {
    this->Decoder = RangeDecoder(this->First + this->RecordLength, this->Size - this->RecordLength);
    for (PointwiseItem& item : this->Items)
    {
      const std::uint8_t* const first = this->First + item.Item.Offset;
      std::copy_n(first, item.Item.Size, item.Last.begin());
      switch (item.Item.What)
      {
        case LazItem::Kind::Point10:
          item.Point->reset(first);
          break;
        case LazItem::Kind::Time11:
          item.Time->reset(valueAt<std::uint64_t>(first));
          break;
        case LazItem::Kind::Colour12:
          item.Colour->reset();
          break;
        case LazItem::Kind::Wave13:
          item.Wave->reset();
          break;
        default:
          item.Bytes[0].reset(256);
          std::fill(item.Bytes.begin() + 1, item.Bytes.end(), item.Bytes[0]);
          break;
      }
    }
  }

  /// Returns false if the item is damaged.
  static bool decodeItem(RangeDecoder& decoder, PointwiseItem& item, std::uint8_t* record)
  {
    switch (item.Item.What)
    {
      case LazItem::Kind::Time11:
      {
        const bool isGood = item.Time->decode(decoder);
        setValue(record, item.Time->time());
        return isGood;
      }
      case LazItem::Kind::Colour12:
      {
        std::array<std::uint16_t, 3> colour;
        std::memcpy(colour.data(), item.Last.data(), sizeof colour);
        item.Colour->decode(decoder, colour.data());
        std::memcpy(item.Last.data(), colour.data(), sizeof colour);
        break;
      }
      case LazItem::Kind::Wave13:
        item.Wave->decode(decoder, item.Last.data());
        break;
      default:
        for (std::size_t i = 0; i < item.Item.Size; ++i)
        {
          item.Last[i] = std::uint8_t(item.Last[i] + decoder.symbol(item.Bytes[i]));
        }
        break;
    }
    std::memcpy(record, item.Last.data(), item.Item.Size);
    return true;
  }

  std::vector<PointwiseItem> Items;
  RangeDecoder Decoder;
  std::size_t Size = 0;
};

} // namespace

std::unique_ptr<LazChunkDecoder> pointwiseDecoder(const LazFormat& format)
{
  return std::make_unique<PointwiseChunk>(format);
}

} // namespace tipp
