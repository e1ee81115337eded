// SPDX-License-Identifier: BSD-3-Clause
#include "Laz/LazChunk.h"
#include "Laz/LazItems.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <vector>

namespace tipp
{
namespace
{

constexpr unsigned channels = 4; ///< scanner channels, each of which has models of its own

/// Returns the context of X and Y by the return number and the number of returns, 0 to 15 (LAZ
/// specification, POINT14): the first few returns apart, the last one, and those between.
constexpr unsigned context14(unsigned number, unsigned count)
{
  const unsigned low = number < count ? number : count;
  const unsigned high = number < count ? count : number;
  constexpr std::array<std::uint8_t, 10> withoutCount = { 0, 1, 2, 3, 4, 5, 3, 4, 4, 5 };
  constexpr unsigned some = 4;
  constexpr unsigned last = 5;
  if (low == 0)
  {
    return withoutCount[high < 9 ? high : 9];
  }
  if (low <= 2)
  {
    return high <= 2 ? low + high - 2 : low == 1 || high > 10 ? 3 : some;
  }
  return high - low <= (high >= 12 ? 1U : 0U) ? last : some;
}

/// Contexts by the byte of returns.
struct ReturnContexts14
{
  std::array<std::uint8_t, 256> Pair{};  ///< 6 contexts
  std::array<std::uint8_t, 256> Level{}; ///< 8 contexts: returns after this one
  std::array<std::uint8_t, 256> Place{}; ///< 1: the last return, 2: the first, 3: both

  constexpr ReturnContexts14()
  {
    for (unsigned byte = 0; byte < 256; ++byte)
    {
      const unsigned number = byte & 15U;
      const unsigned count = byte >> 4;
      const unsigned level = number < count ? count - number : number - count;
      this->Pair[byte] = std::uint8_t(context14(number, count));
      this->Level[byte] = std::uint8_t(level < 7 ? level : 7);
      this->Place[byte] = std::uint8_t((number == 1 ? 2 : 0) + (number >= count ? 1 : 0));
    }
  }
};
constexpr ReturnContexts14 contexts14;

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

/// The models and the last point of a scanner channel.
struct Channel
{
  std::int32_t LastX = 0;
  std::int32_t LastY = 0;
  std::int32_t LastZ = 0;
  std::uint16_t LastIntensity = 0;
  std::uint8_t LastReturns = 0;
  std::uint8_t LastFlags = 0; ///< 0 to 3: of the class, 4: direction, 5: edge
  std::uint8_t LastClass = 0;
  std::uint8_t LastUserData = 0;
  std::int16_t LastAngle = 0;
  std::uint16_t LastSource = 0;
  std::uint64_t LastTime = 0;
  bool HasTimeChanged = false;

  std::array<SymbolModel<128>, 8> Changes; ///< by the last return's place and change of time
  SymbolModel<3> ChannelSteps;
  ContextModels<16, 16> Counts;
  ContextModels<16, 16> Numbers;
  SymbolModel<13> NumberSteps;
  std::array<std::array<StreamingMedian, 2>, 6> MedianX; ///< by returns and change of time
  std::array<std::array<StreamingMedian, 2>, 6> MedianY;
  IntegerDecoder<32, 2> X;
  IntegerDecoder<32, 22> Y;

  std::array<std::int32_t, 8> LevelZ{};
  IntegerDecoder<32, 20> Z;
  ContextModels<256, 64> Classes;
  ContextModels<64, 64> Flags;
  std::array<std::array<std::uint16_t, 2>, 4> Intensity{};
  IntegerDecoder<16, 4> Intensities;
  IntegerDecoder<16, 2> Angles;
  ContextModels<256, 64> UserData;
  IntegerDecoder<16, 1> Sources;
  TimeDecoder<false> Times;
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

  std::size_t layers() const override { return LayerCount; }

  bool wants(std::size_t layer) const override
  {
    constexpr std::array<unsigned, LayerCount> attributes = { ~0U, laz::Z, laz::Class, laz::Flags,
      laz::Intensity, laz::Angle, laz::UserData, laz::Source, laz::Time };
    return layer == XYLayer || (this->Attributes & attributes[layer]) != 0;
  }

  void begin(const std::uint8_t* first, unsigned channel) override
  {
    this->IsReady.fill(false);
    Channel& last = this->prepare(channel);
    last.LastX = valueAt<std::int32_t>(first);
    last.LastY = valueAt<std::int32_t>(first + 4);
    last.LastZ = valueAt<std::int32_t>(first + 8);
    last.LastIntensity = valueAt<std::uint16_t>(first + 12);
    last.LastReturns = first[14];
    last.LastFlags = std::uint8_t((first[15] & 15U) | (unsigned(first[15] >> 6) << 4));
    last.LastClass = first[16];
    last.LastUserData = first[17];
    last.LastAngle = valueAt<std::int16_t>(first + 18);
    last.LastSource = valueAt<std::uint16_t>(first + 20);
    last.LastTime = valueAt<std::uint64_t>(first + 22);
    this->resetState(last);
    this->Current = channel;
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
  enum LayerNumber : std::size_t
  {
    XYLayer,
    ZLayer,
    ClassLayer,
    FlagsLayer,
    IntensityLayer,
    AngleLayer,
    UserDataLayer,
    SourceLayer,
    TimeLayer,
    LayerCount
  };

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
      , IsVersion3(points.Item.Version < 4)
      , Last(points.Channels[points.Current].get())
      , Record(record)
      , ItemChannel(channel)
    {
      for (std::size_t i = FlagsLayer; i < LayerCount; ++i)
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
        this->Last = this->Points.changeChannel(step, *this->Last);
      }
      // In version 3 the other items' channel is 0 unless the channel has just changed.
      *this->ItemChannel++ =
        std::uint8_t(this->IsVersion3 && !isOtherChannel ? 0 : this->Points.Current);
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
        const bool isSingle = contexts14.Place[this->Last->LastReturns] == 3;
        const unsigned context = (this->Last->LastClass & 31U) * 2 + (isSingle ? 1 : 0);
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
      this->Points.store(*this->Last, this->Record);
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
    const bool IsVersion3;
    unsigned Changes = 0;
    unsigned TimeChanged = 0;
    unsigned Single = 0;
    unsigned Pair = 0;
    Channel* Last;
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

  /// 1: the first return, 2: the last one, 3: both.
  static unsigned lastPlaces(std::uint8_t returns)
  {
    constexpr std::array<std::uint8_t, 4> swapped = { 0, 2, 1, 3 };
    return swapped[contexts14.Place[returns]];
  }

  /// Initialises the models of a channel, of the layers that are used.
  Channel& prepare(unsigned number)
  {
    std::unique_ptr<Channel>& channel = this->Channels[number];
    if (!channel)
    {
      channel = std::make_unique<Channel>();
    }
    channel->Changes[0].reset(128);
    std::fill(channel->Changes.begin() + 1, channel->Changes.end(), channel->Changes[0]);
    channel->ChannelSteps.reset(3);
    channel->Counts.reset();
    channel->Numbers.reset();
    channel->NumberSteps.reset(13);
    channel->MedianX = {};
    channel->MedianY = {};
    channel->X.reset();
    channel->Y.reset();
    const auto resetIf = [this](LayerNumber layer, auto& models)
    {
      if (this->Layers[layer].IsUsed)
      {
        models.reset();
      }
    };
    resetIf(ZLayer, channel->Z);
    resetIf(ClassLayer, channel->Classes);
    resetIf(FlagsLayer, channel->Flags);
    resetIf(IntensityLayer, channel->Intensities);
    resetIf(AngleLayer, channel->Angles);
    resetIf(UserDataLayer, channel->UserData);
    resetIf(SourceLayer, channel->Sources);
    this->IsReady[number] = true;
    return *channel;
  }

  /// Initialises what depends on the channel's last point.
  void resetState(Channel& channel) const
  {
    channel.HasTimeChanged = false;
    channel.LevelZ.fill(channel.LastZ);
    for (auto& intensities : channel.Intensity)
    {
      intensities.fill(channel.LastIntensity);
    }
    if (this->Layers[TimeLayer].IsUsed)
    {
      channel.Times.reset(channel.LastTime);
    }
  }

  [[gnu::noinline]] Channel* changeChannel(unsigned step, const Channel& from)
  {
    this->Current = (this->Current + step) % channels;
    if (!this->IsReady[this->Current])
    {
      Channel& to = this->prepare(this->Current);
      to.LastX = from.LastX;
      to.LastY = from.LastY;
      to.LastZ = from.LastZ;
      to.LastIntensity = from.LastIntensity;
      to.LastReturns = from.LastReturns;
      to.LastFlags = from.LastFlags;
      to.LastClass = from.LastClass;
      to.LastUserData = from.LastUserData;
      to.LastAngle = from.LastAngle;
      to.LastSource = from.LastSource;
      to.LastTime = from.LastTime;
      this->resetState(to);
    }
    return this->Channels[this->Current].get();
  }

  [[gnu::always_inline]] static void decodeReturns(
    RangeDecoder& decoder, Channel& last, unsigned changes)
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
  bool decodeOthers(Channel& last, unsigned place, unsigned changes)
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

  void store(const Channel& last, std::uint8_t* record) const
  {
    setValue(record, last.LastX);
    setValue(record + 4, last.LastY);
    setValue(record + 8, last.LastZ);
    setValue(record + 12, last.LastIntensity);
    record[14] = last.LastReturns;
    record[15] = std::uint8_t(
      (last.LastFlags & 15U) | (this->Current << 4) | (unsigned(last.LastFlags >> 4) << 6));
    record[16] = last.LastClass;
    record[17] = last.LastUserData;
    setValue(record + 18, last.LastAngle);
    setValue(record + 20, last.LastSource);
    setValue(record + 22, last.LastTime);
  }

  const unsigned Attributes;
  std::array<std::unique_ptr<Channel>, channels> Channels;
  std::array<bool, channels> IsReady{};
  unsigned Current = 0;
};

/// An item whose bytes are predicted by its last bytes in the same channel.
class FollowingItem : public LayeredItem
{
public:
  FollowingItem(const LazItem& item, bool isWanted)
    : LayeredItem(item)
    , IsWanted(isWanted)
  {
    for (std::vector<std::uint8_t>& last : this->Last)
    {
      last.resize(item.Size);
    }
  }

  bool wants(std::size_t /*layer*/) const override { return this->IsWanted; }

  void begin(const std::uint8_t* first, unsigned channel) override
  {
    this->IsReady.fill(false);
    this->Current = channel;
    std::copy_n(first, this->Item.Size, this->Last[channel].begin());
    this->prepare(channel);
  }

  bool decode(std::size_t count, std::uint8_t* records, std::size_t recordLength,
    std::uint8_t* channel) override
  {
    for (std::size_t i = 0; i < count; ++i, records += recordLength)
    {
      const unsigned from = this->Current;
      this->Current = channel[i];
      std::uint8_t* const last = this->lastBytes(from);
      this->decodeNext(this->Current, last);
      std::memcpy(records, last, this->Item.Size);
    }
    return true;
  }

protected:
  virtual void resetModels(unsigned channel) = 0;
  /// Replaces the last bytes by the next ones, with the models of the channel.
  virtual void decodeNext(unsigned channel, std::uint8_t* last) = 0;

private:
  void prepare(unsigned channel)
  {
    this->resetModels(channel);
    this->IsReady[channel] = true;
  }

  /// Returns the bytes by which the next ones are predicted. Version 3 takes those of the channel
  /// before, if that has just changed to one that was there already.
  std::uint8_t* lastBytes(unsigned from)
  {
    const unsigned to = this->Current;
    if (!this->IsReady[to])
    {
      this->Last[to] = this->Last[from];
      this->prepare(to);
      return this->Last[to].data();
    }
    return this->Last[this->Item.Version < 4 ? from : to].data();
  }

  const bool IsWanted;
  std::array<std::vector<std::uint8_t>, channels> Last;
  std::array<bool, channels> IsReady{};
  unsigned Current = 0;
};

/// The models of the channels, which are there once they are used.
template <typename Models>
class ModelsOfChannels
{
public:
  Models& of(unsigned channel)
  {
    if (!this->There[channel])
    {
      this->There[channel] = std::make_unique<Models>();
    }
    return *this->There[channel];
  }

private:
  std::array<std::unique_ptr<Models>, channels> There;
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
      Infrared& models = this->Infrareds.of(channel);
      models.Changes.reset(4);
      models.Bytes[0].reset(256);
      models.Bytes[1] = models.Bytes[0];
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
      Infrared& models = this->Infrareds.of(channel);
      RangeDecoder& decoder = this->Layers[1].Decoder;
      const unsigned changes = decoder.symbol(models.Changes);
      for (std::size_t i = 0; i < 2; ++i)
      {
        if (changes & (1U << i))
        {
          last[6 + i] = std::uint8_t(last[6 + i] + decoder.symbol(models.Bytes[i]));
        }
      }
    }
  }

private:
  struct Infrared
  {
    SymbolModel<4> Changes;
    std::array<SymbolModel<256>, 2> Bytes;
  };

  const bool HasInfrared;
  const bool WantsInfrared;
  ModelsOfChannels<ColourDecoder> Colours;
  ModelsOfChannels<Infrared> Infrareds;
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
  void resetModels(unsigned channel) override
  {
    std::vector<SymbolModel<256>>& models = this->Models.of(channel);
    models.resize(this->Item.Size);
    models[0].reset(256);
    std::fill(models.begin() + 1, models.end(), models[0]);
  }

  void decodeNext(unsigned channel, std::uint8_t* last) override
  {
    std::vector<SymbolModel<256>>& models = this->Models.of(channel);
    for (std::size_t i = 0; i < this->Item.Size; ++i)
    {
      if (this->Layers[i].IsUsed)
      {
        last[i] = std::uint8_t(last[i] + this->Layers[i].Decoder.symbol(models[i]));
      }
    }
  }

private:
  ModelsOfChannels<std::vector<SymbolModel<256>>> Models;
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
