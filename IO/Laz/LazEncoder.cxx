// SPDX-License-Identifier: BSD-3-Clause
#include "Laz/LazEncoder.h"

#include "Laz/LayeredModels.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace tipp
{
namespace
{

/// The bytes of an attribute in a chunk. There are none if it is the same in all points.
struct EncodedLayer
{
  RangeEncoder Encoder;
  bool IsUsed = false;

  std::size_t size() const { return this->IsUsed ? this->Encoder.size() : 0; }
};

/// The records of a chunk. `Item` is where those of an item begin.
struct ChunkRecords
{
  std::size_t Count;
  std::size_t Length;
  const std::uint8_t* Item;

  const std::uint8_t* operator[](std::size_t i) const { return this->Item + i * this->Length; }

  /// Whether some of `size` bytes at `offset`, or the bits of `mask` in one byte, change.
  bool change(std::size_t offset, std::size_t size, unsigned mask = 255) const
  {
    const std::uint8_t* const first = this->Item + offset;
    for (std::size_t i = 1; i < this->Count; ++i)
    {
      const std::uint8_t* const next = (*this)[i] + offset;
      const bool isEqual = mask == 255 ? std::memcmp(first, next, size) == 0
                                       : ((unsigned(*first) ^ unsigned(*next)) & mask) == 0;
      if (!isEqual)
      {
        return true;
      }
    }
    return false;
  }
};

/// The part of a chunk's encoder for one item of the records.
class ItemEncoder
{
public:
  ItemEncoder(const LazItem& item, std::size_t layers)
    : Item(item)
    , Layers(layers)
  {
  }
  virtual ~ItemEncoder() = default;

  /// Finds the layers that are used.
  virtual void survey(const ChunkRecords& records) = 0;
  /// Encodes all points but the first. `channel` has the channel of each, which PointEncoder sets
  /// and the other items follow.
  virtual void encode(const ChunkRecords& records, std::vector<std::uint8_t>& channel) = 0;

  const LazItem Item;
  std::vector<EncodedLayer> Layers;
};

/// Encodes the 30 bytes that points of all formats 6 to 10 begin with: the twin of Point14 in
/// LayeredChunk.cxx.
class PointEncoder : public ItemEncoder
{
public:
  explicit PointEncoder(const LazItem& item)
    : ItemEncoder(item, LayerCount14)
  {
  }

  void survey(const ChunkRecords& records) override
  {
    // These two are always there.
    this->Layers[XYLayer].IsUsed = true;
    this->Layers[ZLayer].IsUsed = true;
    this->Layers[ClassLayer].IsUsed = records.change(16, 1);
    constexpr unsigned flags = 0xCF; // all bits but the scanner channel's
    this->Layers[FlagsLayer].IsUsed = records.change(15, 1, flags);
    this->Layers[IntensityLayer].IsUsed = records.change(12, 2);
    this->Layers[AngleLayer].IsUsed = records.change(18, 2);
    this->Layers[UserDataLayer].IsUsed = records.change(17, 1);
    this->Layers[SourceLayer].IsUsed = records.change(20, 2);
    this->Layers[TimeLayer].IsUsed = records.change(22, 8);
  }

  void encode(const ChunkRecords& records, std::vector<std::uint8_t>& channel) override
  {
    std::array<bool, LayerCount14> used;
    for (std::size_t i = 0; i < used.size(); ++i)
    {
      used[i] = this->Layers[i].IsUsed;
    }
    this->Channels.start(records[0], used);
    for (std::size_t i = 1; i < records.Count; ++i)
    {
      channel[i] = this->encodePoint(records[i]);
    }
  }

private:
  /// Which attributes change, as bits, and how the return number does.
  enum Change : unsigned
  {
    NumberChange = 3, ///< 1: one more, 2: one less, 3: otherwise
    CountChange = 4,
    AngleChange = 8,
    TimeChange = 16,
    SourceChange = 32,
    ChannelChange = 64
  };

  RangeEncoder& layer(Layer14 number) { return this->Layers[number].Encoder; }
  bool isUsed(Layer14 number) const { return this->Layers[number].IsUsed; }

  static unsigned changesOf(const LastPoint14& last, const LastPoint14& next)
  {
    constexpr std::array<std::uint8_t, 16> kinds = { 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
      2 };
    return unsigned(kinds[(next.LastReturns - last.LastReturns) & 15U]) |
      (next.LastReturns >> 4 != last.LastReturns >> 4 ? CountChange : 0U) |
      (next.LastAngle != last.LastAngle ? AngleChange : 0U) |
      (next.LastTime != last.LastTime ? TimeChange : 0U) |
      (next.LastSource != last.LastSource ? SourceChange : 0U);
  }

  /// Encodes a point, and returns the channel of the other items.
  std::uint8_t encodePoint(const std::uint8_t* record)
  {
    LastPoint14 next;
    next.load(record);
    const unsigned number = (record[15] >> 4) & 3U;
    Channel14* last = &this->Channels.current();
    RangeEncoder& xy = this->layer(XYLayer);
    const bool isOtherChannel = number != this->Channels.number();
    const unsigned changes = changesOf(this->Channels.before(number), next) |
      (isOtherChannel ? unsigned(ChannelChange) : 0U);
    xy.symbol(
      last->Changes[lastPlaces(last->LastReturns) + (last->HasTimeChanged ? 4 : 0)], changes);
    if (isOtherChannel)
    {
      const unsigned steps = (number - this->Channels.number()) % scannerChannels;
      xy.symbol(last->ChannelSteps, steps - 1);
      last = &this->Channels.change(number);
    }
    encodeReturns(xy, *last, next.LastReturns, changes);
    this->encodePosition(*last, next, (changes & TimeChange) != 0);
    this->encodeOthers(*last, next, changes);
    static_cast<LastPoint14&>(*last) = next;
    last->HasTimeChanged = (changes & TimeChange) != 0;
    return itemChannel(this->Item.Version, isOtherChannel, number);
  }

  static void encodeReturns(
    RangeEncoder& encoder, Channel14& last, unsigned returns, unsigned changes)
  {
    const unsigned lastNumber = last.LastReturns & 15U;
    const unsigned number = returns & 15U;
    if (changes & CountChange)
    {
      encoder.symbol(last.Counts.of(last.LastReturns >> 4), returns >> 4);
    }
    if ((changes & NumberChange) == 3)
    {
      if (changes & TimeChange)
      {
        encoder.symbol(last.Numbers.of(lastNumber), number);
      }
      else
      {
        encoder.symbol(last.NumberSteps, ((number - lastNumber) & 15U) - 2);
      }
    }
  }

  void encodePosition(Channel14& last, const LastPoint14& next, bool hasTimeChanged)
  {
    RangeEncoder& xy = this->layer(XYLayer);
    const unsigned single = next.LastReturns >> 4 == 1 ? 1 : 0;
    const unsigned pair = contexts14.Pair[next.LastReturns];
    const auto stepOf = [](std::int32_t from, std::int32_t to)
    { return std::int32_t(std::uint32_t(to) - std::uint32_t(from)); };
    StreamingMedian& medianX = last.MedianX[pair][hasTimeChanged ? 1 : 0];
    const std::int32_t stepX = stepOf(last.LastX, next.LastX);
    last.X.encode(xy, medianX.median(), stepX, single);
    medianX.add(stepX);
    StreamingMedian& medianY = last.MedianY[pair][hasTimeChanged ? 1 : 0];
    const std::int32_t stepY = stepOf(last.LastY, next.LastY);
    last.Y.encode(xy, medianY.median(), stepY, single + contextOfWidth(last.X.width(), 20));
    medianY.add(stepY);
    const unsigned width = (last.X.width() + last.Y.width()) / 2;
    std::int32_t& level = last.LevelZ[contexts14.Level[next.LastReturns]];
    last.Z.encode(this->layer(ZLayer), level, next.LastZ, single + contextOfWidth(width, 18));
    level = next.LastZ;
  }

  void encodeOthers(Channel14& last, const LastPoint14& next, unsigned changes)
  {
    const unsigned hasTimeChanged = changes & TimeChange ? 1 : 0;
    const unsigned place = contexts14.Place[next.LastReturns];
    last.LastReturns = next.LastReturns;
    if (this->isUsed(ClassLayer))
    {
      this->layer(ClassLayer).symbol(last.Classes.of(contextOfClass(last)), next.LastClass);
    }
    if (this->isUsed(FlagsLayer))
    {
      this->layer(FlagsLayer).symbol(last.Flags.of(last.LastFlags), next.LastFlags);
    }
    if (this->isUsed(IntensityLayer))
    {
      std::uint16_t& intensity = last.Intensity[place][hasTimeChanged];
      last.Intensities.encode(this->layer(IntensityLayer), intensity, next.LastIntensity, place);
      intensity = next.LastIntensity;
    }
    if (changes & AngleChange)
    {
      last.Angles.encode(this->layer(AngleLayer), last.LastAngle, next.LastAngle, hasTimeChanged);
    }
    if (this->isUsed(UserDataLayer))
    {
      this->layer(UserDataLayer)
        .symbol(last.UserData.of(last.LastUserData / 4U), next.LastUserData);
    }
    if (changes & SourceChange)
    {
      last.Sources.encode(this->layer(SourceLayer), last.LastSource, next.LastSource, 0);
    }
    if (changes & TimeChange)
    {
      last.Times.encode(this->layer(TimeLayer), next.LastTime);
    }
  }

  Channels14 Channels;
};

/// An item whose bytes are predicted by its last bytes in the same channel.
class FollowingEncoder : public ItemEncoder
{
public:
  using ItemEncoder::ItemEncoder;

  void encode(const ChunkRecords& records, std::vector<std::uint8_t>& channel) override
  {
    this->Last.start(records[0], this->Item.Size, channel[0]);
    this->resetModels(channel[0]);
    for (std::size_t i = 1; i < records.Count; ++i)
    {
      std::uint8_t* const last =
        this->Last.next(channel[i], this->Item.Version, [&] { this->resetModels(channel[i]); });
      this->encodeNext(channel[i], last, records[i]);
      std::memcpy(last, records[i], this->Item.Size);
    }
  }

protected:
  virtual void resetModels(unsigned channel) = 0;
  /// Encodes the bytes that follow the last ones, with the models of the channel.
  virtual void encodeNext(unsigned channel, const std::uint8_t* last, const std::uint8_t* next) = 0;

private:
  LastBytes Last;
};

/// Red, green and blue, and infrared where the item has it.
class ColourEncoder : public FollowingEncoder
{
public:
  explicit ColourEncoder(const LazItem& item)
    : FollowingEncoder(item, item.What == LazItem::Kind::ColourInfrared14 ? 2 : 1)
  {
  }

  void survey(const ChunkRecords& records) override
  {
    this->Layers[0].IsUsed = records.change(0, 6);
    if (this->hasInfrared())
    {
      this->Layers[1].IsUsed = records.change(6, 2);
    }
  }

protected:
  void resetModels(unsigned channel) override
  {
    this->Colours.of(channel).reset();
    if (this->hasInfrared())
    {
      this->Infrareds.of(channel).reset();
    }
  }

  void encodeNext(unsigned channel, const std::uint8_t* last, const std::uint8_t* next) override
  {
    if (this->Layers[0].IsUsed)
    {
      using Colour = std::array<std::uint16_t, 3>;
      this->Colours.of(channel).encode(
        this->Layers[0].Encoder, valueAt<Colour>(last).data(), valueAt<Colour>(next).data());
    }
    if (this->hasInfrared() && this->Layers[1].IsUsed)
    {
      this->Infrareds.of(channel).encode(this->Layers[1].Encoder, last + 6, next + 6);
    }
  }

private:
  bool hasInfrared() const { return this->Layers.size() > 1; }

  ModelsOfChannels<ColourCoder> Colours;
  ModelsOfChannels<InfraredCoder> Infrareds;
};

/// Extra bytes, each of which has a layer.
class BytesEncoder : public FollowingEncoder
{
public:
  explicit BytesEncoder(const LazItem& item)
    : FollowingEncoder(item, item.Size)
  {
  }

  void survey(const ChunkRecords& records) override
  {
    for (std::size_t i = 0; i < this->Layers.size(); ++i)
    {
      this->Layers[i].IsUsed = records.change(i, 1);
    }
  }

protected:
  void resetModels(unsigned channel) override { this->Models.of(channel).reset(this->Item.Size); }

  void encodeNext(unsigned channel, const std::uint8_t* last, const std::uint8_t* next) override
  {
    std::vector<SymbolModel<256>>& models = this->Models.of(channel).Models;
    for (std::size_t i = 0; i < this->Item.Size; ++i)
    {
      if (this->Layers[i].IsUsed)
      {
        this->Layers[i].Encoder.symbol(models[i], unsigned(next[i] - last[i]) & 255U);
      }
    }
  }

private:
  ModelsOfChannels<ByteModels> Models;
};

std::unique_ptr<ItemEncoder> makeEncoder(const LazItem& item)
{
  switch (item.What)
  {
    case LazItem::Kind::Point14:
      return std::make_unique<PointEncoder>(item);
    case LazItem::Kind::Colour14:
    case LazItem::Kind::ColourInfrared14:
      return std::make_unique<ColourEncoder>(item);
    default:
      return std::make_unique<BytesEncoder>(item);
  }
}

} // namespace

class LazChunkEncoder::Items
{
public:
  explicit Items(const LazFormat& format)
    : RecordLength(format.RecordLength)
  {
    for (const LazItem& item : format.Items)
    {
      this->All.push_back(makeEncoder(item));
    }
  }

  void encode(std::size_t count, const std::uint8_t* records, std::vector<std::uint8_t>& bytes)
  {
    this->Channel.resize(count);
    this->Channel[0] = (records[15] >> 4) & 3U;
    for (const std::unique_ptr<ItemEncoder>& item : this->All)
    {
      const ChunkRecords part = { count, this->RecordLength, records + item->Item.Offset };
      item->survey(part);
      for (EncodedLayer& layer : item->Layers)
      {
        layer.Encoder.reset();
      }
      item->encode(part, this->Channel);
      for (EncodedLayer& layer : item->Layers)
      {
        layer.Encoder.finish();
      }
    }
    this->store(count, records, bytes);
  }

private:
  /// A chunk has its first point, then the number of points and the sizes of all layers, then the
  /// layers.
  void store(std::size_t count, const std::uint8_t* records, std::vector<std::uint8_t>& bytes) const
  {
    const auto addCount = [&bytes](std::size_t number)
    {
      bytes.resize(bytes.size() + 4);
      setValue(&bytes[bytes.size() - 4], std::uint32_t(number));
    };
    bytes.insert(bytes.end(), records, records + this->RecordLength);
    addCount(count);
    this->forLayers([&](const EncodedLayer& layer) { addCount(layer.size()); });
    this->forLayers(
      [&](const EncodedLayer& layer)
      {
        const std::uint8_t* const begin = layer.Encoder.bytes();
        bytes.insert(bytes.end(), begin, begin + layer.size());
      });
  }

  template <typename Visit>
  void forLayers(const Visit& visit) const
  {
    for (const std::unique_ptr<ItemEncoder>& item : this->All)
    {
      for (const EncodedLayer& layer : item->Layers)
      {
        visit(layer);
      }
    }
  }

  const std::size_t RecordLength;
  std::vector<std::unique_ptr<ItemEncoder>> All;
  std::vector<std::uint8_t> Channel; ///< of each point's items
};

LazChunkEncoder::LazChunkEncoder(const LazFormat& format)
  : Parts(std::make_unique<Items>(format))
{
}

LazChunkEncoder::~LazChunkEncoder() = default;
LazChunkEncoder::LazChunkEncoder(LazChunkEncoder&&) noexcept = default;

void LazChunkEncoder::encode(
  std::size_t count, const std::uint8_t* records, std::vector<std::uint8_t>& bytes)
{
  this->Parts->encode(count, records, bytes);
}

} // namespace tipp
