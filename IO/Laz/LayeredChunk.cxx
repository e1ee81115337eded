// SPDX-License-Identifier: BSD-3-Clause
#include "Laz/LayeredModels.h"
#include "Laz/LazChunk.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <vector>

namespace tipp
{
namespace
{

/// The bytes of an attribute in a chunk. There are none if it is the same in all points, and they
/// are left alone if it is not asked for.
struct Layer
{
  RangeDecoder Decoder;
  bool IsUsed = false;
};

/// An item of a record. Its layers are read in the order of the items.
class LayeredItem
{
public:
  explicit LayeredItem(const LazItem& item)
    : Item(item)
  {
  }
  virtual ~LayeredItem() = default;

  virtual std::size_t layers() const { return 1; }
  /// Whether a layer is asked for.
  virtual bool wants(std::size_t layer) const = 0;
  virtual void begin(const std::uint8_t* first, unsigned channel) = 0;
  /// Decodes points: each has its channel, which Point14 tells and the other items follow. Returns
  /// false if bytes are damaged.
  virtual bool decode(
    std::size_t count, std::uint8_t* records, std::size_t recordLength, std::uint8_t* channel) = 0;

  const LazItem Item;
  Layer* Layers = nullptr; ///< its own, of the chunk
};

/// Decodes the 30 bytes that points of all formats 6 to 10 begin with.
class Point14 : public LayeredItem
{
public:
  Point14(const LazItem& item, unsigned attributes)
    : LayeredItem(item)
    , Attributes(attributes)
  {
  }

  std::size_t layers() const override { return LayerCount14; }

  bool wants(std::size_t layer) const override
  {
    constexpr std::array<unsigned, LayerCount14> attributes = { ~0U, laz::Z, laz::Class, laz::Flags,
      laz::Intensity, laz::Angle, laz::UserData, laz::Source, laz::Time };
    return layer == XYLayer || (this->Attributes & attributes[layer]) != 0;
  }

  void begin(const std::uint8_t* first, unsigned /*channel*/) override
  {
    std::array<bool, LayerCount14> used;
    for (std::size_t i = 0; i < used.size(); ++i)
    {
      used[i] = this->Layers[i].IsUsed;
    }
    this->Channels.start(first, used);
  }

  bool decode(std::size_t count, std::uint8_t* records, std::size_t recordLength,
    std::uint8_t* channel) override
  {
    std::array<Stream, 1> streams = { Stream(*this, records, channel) };
    return decodeStreams(streams, count, recordLength);
  }

  /// Decodes the same number of points of two chunks, see Stream.
  bool decodeWith(Point14& other, std::size_t count, std::size_t recordLength,
    const std::array<std::uint8_t*, 2>& records, const std::array<std::uint8_t*, 2>& channel)
  {
    std::array<Stream, 2> streams = { Stream(*this, records[0], channel[0]),
      Stream(other, records[1], channel[1]) };
    return decodeStreams(streams, count, recordLength);
  }

private:
  /// The state of a chunk while some of its points are decoded, in steps of a symbol. A symbol
  /// needs the one before it, so that a processor that decodes one chunk mostly waits; the steps
  /// of two chunks in turn fill the time.
  struct Stream
  {
    Stream(Point14& points, std::uint8_t* record, std::uint8_t* channel)
      : Points(points)
      , XY(points.Layers[XYLayer].Decoder)
      , Heights(points.Layers[ZLayer].Decoder)
      , Classes(points.Layers[ClassLayer].Decoder)
      , HasZ(points.Layers[ZLayer].IsUsed)
      , HasClass(points.Layers[ClassLayer].IsUsed)
      , Last(&points.Channels.current())
      , Record(record)
      , ItemChannel(channel)
    {
      for (std::size_t i = FlagsLayer; i < LayerCount14; ++i)
      {
        this->HasOthers = this->HasOthers || points.Layers[i].IsUsed;
      }
    }

    [[gnu::always_inline]] void decodeChanges()
    {
      const unsigned place = lastPlaces(this->Last->LastReturns);
      this->Changes =
        this->XY.symbol(this->Last->Changes[place + (this->Last->HasTimeChanged ? 4 : 0)]);
      const unsigned isOtherChannel = this->Changes & 64U;
      if (__builtin_expect(isOtherChannel, 0))
      {
        const unsigned step = this->XY.symbol(this->Last->ChannelSteps) + 1;
        this->Last =
          &this->Points.Channels.change((this->Points.Channels.number() + step) % scannerChannels);
      }
      *this->ItemChannel++ =
        itemChannel(this->Points.Item.Version, isOtherChannel != 0, this->Points.Channels.number());
      this->TimeChanged = (this->Changes >> 4) & 1U;
      decodeReturns(this->XY, *this->Last, this->Changes);
      this->Single = this->Last->LastReturns >> 4 == 1 ? 1 : 0;
      this->Pair = contexts14.Pair[this->Last->LastReturns];
    }

    [[gnu::always_inline]] void decodeWidthX()
    {
      this->Last->X.decodeWidth(this->XY, this->Single);
    }

    [[gnu::always_inline]] void decodeX()
    {
      StreamingMedian& median = this->Last->MedianX[this->Pair][this->TimeChanged];
      const std::int32_t step = this->Last->X.decodeCorrection(this->XY, median.median());
      median.add(step);
      this->Last->LastX = std::int32_t(std::uint32_t(this->Last->LastX) + std::uint32_t(step));
    }

    [[gnu::always_inline]] void decodeWidthY()
    {
      this->Last->Y.decodeWidth(this->XY, this->Single + contextOfWidth(this->Last->X.width(), 20));
    }

    [[gnu::always_inline]] void decodeY()
    {
      StreamingMedian& median = this->Last->MedianY[this->Pair][this->TimeChanged];
      const std::int32_t step = this->Last->Y.decodeCorrection(this->XY, median.median());
      median.add(step);
      this->Last->LastY = std::int32_t(std::uint32_t(this->Last->LastY) + std::uint32_t(step));
    }

    [[gnu::always_inline]] void decodeWidthZ()
    {
      if (this->HasZ)
      {
        const unsigned width = (this->Last->X.width() + this->Last->Y.width()) / 2;
        this->Last->Z.decodeWidth(this->Heights, this->Single + contextOfWidth(width, 18));
      }
    }

    [[gnu::always_inline]] void decodeZ()
    {
      if (this->HasZ)
      {
        std::int32_t& level = this->Last->LevelZ[contexts14.Level[this->Last->LastReturns]];
        level = this->Last->Z.decodeCorrection(this->Heights, level);
        this->Last->LastZ = level;
      }
    }

    [[gnu::always_inline]] void decodeClass()
    {
      if (this->HasClass)
      {
        const unsigned context = contextOfClass(*this->Last);
        this->Last->LastClass = std::uint8_t(
          this->Classes.symbol(this->Last->Classes.of(context), this->Last->LastClass));
      }
    }

    [[gnu::always_inline]] void finish(std::size_t recordLength)
    {
      if (this->HasOthers)
      {
        const unsigned place = contexts14.Place[this->Last->LastReturns];
        this->IsGood = this->Points.decodeOthers(*this->Last, place, this->Changes) && this->IsGood;
      }
      this->Last->HasTimeChanged = this->TimeChanged != 0;
      this->Last->store(this->Points.Channels.number(), this->Record);
      this->Record += recordLength;
    }

    void end()
    {
      this->Points.Layers[XYLayer].Decoder = this->XY;
      this->Points.Layers[ZLayer].Decoder = this->Heights;
      this->Points.Layers[ClassLayer].Decoder = this->Classes;
    }

    Point14& Points;
    // Copies, which the compiler can keep in registers.
    RangeDecoder XY;
    RangeDecoder Heights;
    RangeDecoder Classes;
    const bool HasZ;
    const bool HasClass;
    bool HasOthers = false;
    bool IsGood = true;
    unsigned Changes = 0;
    unsigned TimeChanged = 0;
    unsigned Single = 0;
    unsigned Pair = 0;
    Channel14* Last;
    std::uint8_t* Record;
    std::uint8_t* ItemChannel;
  };

  template <std::size_t Count>
  static bool decodeStreams(
    std::array<Stream, Count>& streams, std::size_t points, std::size_t recordLength)
  {
    const auto each = [&streams](const auto& step)
    {
      step(streams.front());
      if constexpr (Count > 1)
      {
        step(streams[1]);
      }
    };
    for (; points > 0; --points)
    {
      each([](Stream& s) { s.decodeChanges(); });
      each([](Stream& s) { s.decodeWidthX(); });
      each([](Stream& s) { s.decodeX(); });
      each([](Stream& s) { s.decodeWidthY(); });
      each([](Stream& s) { s.decodeY(); });
      each([](Stream& s) { s.decodeWidthZ(); });
      each([](Stream& s) { s.decodeZ(); });
      each([](Stream& s) { s.decodeClass(); });
      each([=](Stream& s) { s.finish(recordLength); });
    }
    bool isGood = true;
    for (Stream& stream : streams)
    {
      stream.end();
      isGood = isGood && stream.IsGood;
    }
    return isGood;
  }

  [[gnu::always_inline]] static void decodeReturns(
    RangeDecoder& decoder, Channel14& last, unsigned changes)
  {
    const unsigned lastNumber = last.LastReturns & 15U;
    unsigned count = last.LastReturns >> 4;
    if (changes & 4U)
    {
      count = decoder.symbol(last.Counts.of(count));
    }
    constexpr unsigned steps = 0x00F10; // no step, 1, -1 modulo 16, by a digit each
    unsigned number = lastNumber + ((steps >> (4 * (changes & 3U))) & 15U);
    if ((changes & 3U) == 3)
    {
      number = changes & 16U ? decoder.symbol(last.Numbers.of(lastNumber))
                             : lastNumber + decoder.symbol(last.NumberSteps) + 2;
    }
    last.LastReturns = std::uint8_t((number & 15U) | (count << 4));
  }

  /// Returns false if a time is damaged.
  bool decodeOthers(Channel14& last, unsigned place, unsigned changes)
  {
    const unsigned timeChanged = (changes >> 4) & 1U;
    if (Layer& layer = this->Layers[FlagsLayer]; layer.IsUsed)
    {
      last.LastFlags =
        std::uint8_t(layer.Decoder.symbol(last.Flags.of(last.LastFlags), last.LastFlags));
    }
    if (Layer& layer = this->Layers[IntensityLayer]; layer.IsUsed)
    {
      std::uint16_t& intensity = last.Intensity[place][timeChanged];
      intensity = std::uint16_t(last.Intensities.decode(layer.Decoder, intensity, place));
      last.LastIntensity = intensity;
    }
    if (Layer& layer = this->Layers[AngleLayer]; layer.IsUsed && (changes & 8U))
    {
      last.LastAngle = std::int16_t(last.Angles.decode(layer.Decoder, last.LastAngle, timeChanged));
    }
    if (Layer& layer = this->Layers[UserDataLayer]; layer.IsUsed)
    {
      last.LastUserData = std::uint8_t(
        layer.Decoder.symbol(last.UserData.of(last.LastUserData / 4U), last.LastUserData));
    }
    if (Layer& layer = this->Layers[SourceLayer]; layer.IsUsed && (changes & 32U))
    {
      last.LastSource = std::uint16_t(last.Sources.decode(layer.Decoder, last.LastSource, 0));
    }
    if (Layer& layer = this->Layers[TimeLayer]; layer.IsUsed && timeChanged)
    {
      const bool isGood = last.Times.decode(layer.Decoder);
      last.LastTime = last.Times.time();
      return isGood;
    }
    return true;
  }

  const unsigned Attributes;
  Channels14 Channels;
};

/// An item whose bytes are predicted by its last bytes in the same channel.
class FollowingItem : public LayeredItem
{
public:
  FollowingItem(const LazItem& item, bool isWanted)
    : LayeredItem(item)
    , IsWanted(isWanted)
  {
  }

  bool wants(std::size_t /*layer*/) const override { return this->IsWanted; }

  void begin(const std::uint8_t* first, unsigned channel) override
  {
    this->Last.start(first, this->Item.Size, channel);
    this->resetModels(channel);
  }

  bool decode(std::size_t count, std::uint8_t* records, std::size_t recordLength,
    std::uint8_t* channel) override
  {
    for (std::size_t i = 0; i < count; ++i, records += recordLength)
    {
      std::uint8_t* const last =
        this->Last.next(channel[i], this->Item.Version, [&] { this->resetModels(channel[i]); });
      this->decodeNext(channel[i], last);
      std::memcpy(records, last, this->Item.Size);
    }
    return true;
  }

protected:
  virtual void resetModels(unsigned channel) = 0;
  /// Replaces the last bytes by the next ones, with the models of the channel.
  virtual void decodeNext(unsigned channel, std::uint8_t* last) = 0;

private:
  const bool IsWanted;
  LastBytes Last;
};

/// Red, green and blue, and infrared where the item has it.
class Colour14 : public FollowingItem
{
public:
  Colour14(const LazItem& item, unsigned attributes)
    : FollowingItem(item, (attributes & laz::Colour) != 0)
    , HasInfrared(item.What == LazItem::Kind::ColourInfrared14)
    , WantsInfrared((attributes & laz::Infrared) != 0)
  {
  }

  std::size_t layers() const override { return this->HasInfrared ? 2 : 1; }
  bool wants(std::size_t layer) const override
  {
    return layer == 0 ? FollowingItem::wants(0) : this->WantsInfrared;
  }

protected:
  void resetModels(unsigned channel) override
  {
    if (this->Layers[0].IsUsed)
    {
      this->Colours.of(channel).reset();
    }
    if (this->HasInfrared && this->Layers[1].IsUsed)
    {
      this->Infrareds.of(channel).reset();
    }
  }

  void decodeNext(unsigned channel, std::uint8_t* last) override
  {
    if (this->Layers[0].IsUsed)
    {
      std::array<std::uint16_t, 3> colour;
      std::memcpy(colour.data(), last, sizeof colour);
      this->Colours.of(channel).decode(this->Layers[0].Decoder, colour.data());
      std::memcpy(last, colour.data(), sizeof colour);
    }
    if (this->HasInfrared && this->Layers[1].IsUsed)
    {
      this->Infrareds.of(channel).decode(this->Layers[1].Decoder, last + 6);
    }
  }

private:
  const bool HasInfrared;
  const bool WantsInfrared;
  ModelsOfChannels<ColourCoder> Colours;
  ModelsOfChannels<InfraredCoder> Infrareds;
};

class Wave14 : public FollowingItem
{
public:
  using FollowingItem::FollowingItem;

protected:
  void resetModels(unsigned channel) override
  {
    if (this->Layers[0].IsUsed)
    {
      this->Waves.of(channel).reset();
    }
  }

  void decodeNext(unsigned channel, std::uint8_t* last) override
  {
    if (this->Layers[0].IsUsed)
    {
      this->Waves.of(channel).decode(this->Layers[0].Decoder, last);
    }
  }

private:
  ModelsOfChannels<WaveDecoder> Waves;
};

/// Extra bytes, each of which has a layer.
class Bytes14 : public FollowingItem
{
public:
  using FollowingItem::FollowingItem;

  std::size_t layers() const override { return this->Item.Size; }

protected:
  void resetModels(unsigned channel) override { this->Models.of(channel).reset(this->Item.Size); }

  void decodeNext(unsigned channel, std::uint8_t* last) override
  {
    std::vector<SymbolModel<256>>& models = this->Models.of(channel).Models;
    for (std::size_t i = 0; i < this->Item.Size; ++i)
    {
      if (this->Layers[i].IsUsed)
      {
        last[i] = std::uint8_t(last[i] + this->Layers[i].Decoder.symbol(models[i]));
      }
    }
  }

private:
  ModelsOfChannels<ByteModels> Models;
};

std::unique_ptr<LayeredItem> makeItem(const LazItem& item, unsigned attributes)
{
  switch (item.What)
  {
    case LazItem::Kind::Point14:
      return std::make_unique<Point14>(item, attributes);
    case LazItem::Kind::Colour14:
    case LazItem::Kind::ColourInfrared14:
      return std::make_unique<Colour14>(item, attributes);
    case LazItem::Kind::Wave14:
      return std::make_unique<Wave14>(item, (attributes & laz::Wave) != 0);
    default:
      return std::make_unique<Bytes14>(item, (attributes & laz::Extra) != 0);
  }
}

/// Decodes points of formats 6 to 10. A chunk has its first point, then the number of points and
/// the sizes of all layers, then the layers.
class LayeredChunk : public LazChunkDecoder
{
public:
  LayeredChunk(const LazFormat& format, unsigned attributes)
    : LazChunkDecoder(format.RecordLength)
  {
    std::size_t layers = 0;
    for (const LazItem& item : format.Items)
    {
      this->Items.push_back(makeItem(item, attributes));
      layers += this->Items.back()->layers();
    }
    this->Layers.resize(layers);
    Layer* next = this->Layers.data();
    for (const std::unique_ptr<LayeredItem>& item : this->Items)
    {
      item->Layers = next;
      next += item->layers();
    }
  }

  std::size_t position() const override { return this->Position; }

private:
  void open(std::size_t size) override
  {
    const std::size_t header = this->RecordLength + 4 + 4 * this->Layers.size();
    if (size < header)
    {
      throw LazError("ends before its layers");
    }
    this->Position = header;
    const std::uint8_t* length = this->First + this->RecordLength + 4;
    for (const std::unique_ptr<LayeredItem>& item : this->Items)
    {
      for (std::size_t i = 0; i < item->layers(); ++i, length += 4)
      {
        const auto layerSize = std::size_t(valueAt<std::uint32_t>(length));
        if (layerSize > size - this->Position)
        {
          throw LazError("has layers that are longer than itself");
        }
        Layer& layer = item->Layers[i];
        layer.IsUsed = layerSize > 0 && item->wants(i);
        layer.Decoder =
          layer.IsUsed ? RangeDecoder(this->First + this->Position, layerSize) : RangeDecoder();
        this->Position += layerSize;
      }
    }
  }

  void decode(std::size_t count, std::uint8_t* records) override
  {
    for (std::size_t done = 0; done < count; done += most)
    {
      this->readSome(std::min(most, count - done), records + done * this->RecordLength);
    }
  }

  void decodeWith(LazChunkDecoder& decoder, std::size_t count, std::uint8_t* records,
    std::uint8_t* otherRecords) override
  {
    auto& other = static_cast<LayeredChunk&>(decoder);
    const std::array<LayeredChunk*, 2> chunks = { this, &other };
    const std::array<std::uint8_t*, 2> begin = { records, otherRecords };
    for (std::size_t done = 0; done < count; done += most)
    {
      const std::size_t some = std::min(most, count - done);
      const std::array<std::uint8_t*, 2> to = { begin[0] + done * this->RecordLength,
        begin[1] + done * this->RecordLength };
      std::array<ItemChannels, 2> channel;
      const bool isGood = this->points().decodeWith(
        other.points(), some, this->RecordLength, to, { channel[0].data(), channel[1].data() });
      for (std::size_t i = 0; i < 2; ++i)
      {
        chunks[i]->readOthers(some, to[i], channel[i], isGood);
      }
    }
  }

  void start() override
  {
    if (!this->Items.front()->Layers[0].IsUsed)
    {
      throw LazError("has no coordinates");
    }
    const unsigned channel = (this->First[15] >> 4) & 3U;
    for (const std::unique_ptr<LayeredItem>& item : this->Items)
    {
      item->begin(this->First + item->Item.Offset, channel);
    }
  }

  /// As many points as stay in the processor's first cache until all items are decoded.
  static constexpr std::size_t most = 256;
  using ItemChannels = std::array<std::uint8_t, most>;

  Point14& points() { return static_cast<Point14&>(*this->Items.front()); }

  void readSome(std::size_t count, std::uint8_t* records)
  {
    ItemChannels channel;
    const bool isGood = this->points().decode(count, records, this->RecordLength, channel.data());
    this->readOthers(count, records, channel, isGood);
  }

  void readOthers(std::size_t count, std::uint8_t* records, ItemChannels& channel, bool isGood)
  {
    for (std::size_t i = 1; i < this->Items.size(); ++i)
    {
      LayeredItem& item = *this->Items[i];
      isGood = item.decode(count, records + item.Item.Offset, this->RecordLength, channel.data()) &&
        isGood;
    }
    for (const Layer& layer : this->Layers)
    {
      isGood = isGood && !(layer.IsUsed && layer.Decoder.isDamaged());
    }
    if (!isGood)
    {
      throw LazError("has damaged compressed points");
    }
  }

  std::vector<std::unique_ptr<LayeredItem>> Items;
  std::vector<Layer> Layers; ///< of all items
  std::size_t Position = 0;
};

} // namespace

std::unique_ptr<LazChunkDecoder> layeredDecoder(const LazFormat& format, unsigned attributes)
{
  return std::make_unique<LayeredChunk>(format, attributes);
}

} // namespace tipp
