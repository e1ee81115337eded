// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLayeredModels_h
#define tippLayeredModels_h

#include "Files/RawValues.h"
#include "Laz/LazItems.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

/// @file
/// What the decoder and the encoder of layered chunks have in common: models, contexts, and by
/// which values the next ones are predicted.

namespace tipp
{

/// Scanner channels, each of which has models of its own.
constexpr unsigned scannerChannels = 4;

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
inline constexpr ReturnContexts14 contexts14;

/// The last point of a scanner channel.
struct LastPoint14
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

  void load(const std::uint8_t* record)
  {
    this->LastX = valueAt<std::int32_t>(record);
    this->LastY = valueAt<std::int32_t>(record + 4);
    this->LastZ = valueAt<std::int32_t>(record + 8);
    this->LastIntensity = valueAt<std::uint16_t>(record + 12);
    this->LastReturns = record[14];
    this->LastFlags = std::uint8_t((record[15] & 15U) | (unsigned(record[15] >> 6) << 4));
    this->LastClass = record[16];
    this->LastUserData = record[17];
    this->LastAngle = valueAt<std::int16_t>(record + 18);
    this->LastSource = valueAt<std::uint16_t>(record + 20);
    this->LastTime = valueAt<std::uint64_t>(record + 22);
  }

  void store(unsigned channel, std::uint8_t* record) const
  {
    setValue(record, this->LastX);
    setValue(record + 4, this->LastY);
    setValue(record + 8, this->LastZ);
    setValue(record + 12, this->LastIntensity);
    record[14] = this->LastReturns;
    record[15] = std::uint8_t(
      (this->LastFlags & 15U) | (channel << 4) | (unsigned(this->LastFlags >> 4) << 6));
    record[16] = this->LastClass;
    record[17] = this->LastUserData;
    setValue(record + 18, this->LastAngle);
    setValue(record + 20, this->LastSource);
    setValue(record + 22, this->LastTime);
  }
};

/// The models of a scanner channel, and its last point.
struct Channel14 : public LastPoint14
{
  bool HasTimeChanged = false;

  std::array<SymbolModel<128>, 8> Changes; ///< by the last return's place and change of time
  SymbolModel<3> ChannelSteps;
  ContextModels<16, 16> Counts;
  ContextModels<16, 16> Numbers;
  SymbolModel<13> NumberSteps;
  std::array<std::array<StreamingMedian, 2>, 6> MedianX; ///< by returns and change of time
  std::array<std::array<StreamingMedian, 2>, 6> MedianY;
  IntegerCoder<32, 2> X;
  IntegerCoder<32, 22> Y;

  std::array<std::int32_t, 8> LevelZ{};
  IntegerCoder<32, 20> Z;
  ContextModels<256, 64> Classes;
  ContextModels<64, 64> Flags;
  std::array<std::array<std::uint16_t, 2>, 4> Intensity{};
  IntegerCoder<16, 4> Intensities;
  IntegerCoder<16, 2> Angles;
  ContextModels<256, 64> UserData;
  IntegerCoder<16, 1> Sources;
  TimeCoder<false> Times;
};

/// The layers of the item that points of formats 6 to 10 begin with.
enum Layer14 : std::size_t
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
  LayerCount14
};

/// The scanner channels of a chunk.
class Channels14
{
public:
  /// Starts with a chunk's first point. `used`: the layers whose models are needed.
  void start(const std::uint8_t* first, const std::array<bool, LayerCount14>& used)
  {
    this->Used = used;
    this->IsReady.fill(false);
    this->Current = (first[15] >> 4) & 3U;
    Channel14& channel = this->prepare();
    channel.load(first);
    this->resetState(channel);
  }

  unsigned number() const { return this->Current; }
  Channel14& current() { return *this->Channels[this->Current]; }

  /// The point that precedes one of channel `number`: that channel's last one, or, if it has none,
  /// the current channel's.
  const LastPoint14& before(unsigned number) const
  {
    return *this->Channels[this->IsReady[number] ? number : this->Current];
  }

  [[gnu::noinline]] Channel14& change(unsigned number)
  {
    const LastPoint14& from = *this->Channels[this->Current];
    this->Current = number;
    if (!this->IsReady[number])
    {
      Channel14& to = this->prepare();
      static_cast<LastPoint14&>(to) = from;
      this->resetState(to);
    }
    return this->current();
  }

private:
  /// Initialises the models of the current channel, of the layers that are used.
  Channel14& prepare()
  {
    std::unique_ptr<Channel14>& channel = this->Channels[this->Current];
    if (!channel)
    {
      channel = std::make_unique<Channel14>();
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
    const auto resetIf = [this](Layer14 layer, auto& models)
    {
      if (this->Used[layer])
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
    this->IsReady[this->Current] = true;
    return *channel;
  }

  /// Initialises what depends on the channel's last point.
  void resetState(Channel14& channel) const
  {
    channel.HasTimeChanged = false;
    channel.LevelZ.fill(channel.LastZ);
    for (auto& intensities : channel.Intensity)
    {
      intensities.fill(channel.LastIntensity);
    }
    if (this->Used[TimeLayer])
    {
      channel.Times.reset(channel.LastTime);
    }
  }

  std::array<bool, LayerCount14> Used{};
  std::array<std::unique_ptr<Channel14>, scannerChannels> Channels;
  std::array<bool, scannerChannels> IsReady{};
  unsigned Current = 0;
};

/// The channel of the items besides the point: in version 3 it is 0 unless the channel has just
/// changed.
inline std::uint8_t itemChannel(int version, bool hasChanged, unsigned channel)
{
  return std::uint8_t(version < 4 && !hasChanged ? 0 : channel);
}

/// The bytes by which those of an item are predicted: its last ones in the same channel.
class LastBytes
{
public:
  void start(const std::uint8_t* first, std::size_t size, unsigned channel)
  {
    this->IsReady.fill(false);
    this->Current = channel;
    this->Last[channel].assign(first, first + size);
    this->IsReady[channel] = true;
  }

  unsigned channel() const { return this->Current; }

  /// Returns the bytes that precede those of a channel's next point, by which they are to be
  /// replaced. Calls prepare() if the channel is a new one. If the scanner channel has just changed
  /// to one that has had points, version 3 goes on from the previous channel's bytes.
  template <typename Prepare>
  std::uint8_t* next(unsigned channel, int version, const Prepare& prepare)
  {
    const unsigned from = this->Current;
    this->Current = channel;
    if (!this->IsReady[channel])
    {
      this->Last[channel] = this->Last[from];
      this->IsReady[channel] = true;
      prepare();
      return this->Last[channel].data();
    }
    return this->Last[version < 4 ? from : channel].data();
  }

private:
  std::array<std::vector<std::uint8_t>, scannerChannels> Last;
  std::array<bool, scannerChannels> IsReady{};
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
  std::array<std::unique_ptr<Models>, scannerChannels> There;
};

/// Codes the two bytes of infrared.
class InfraredCoder
{
public:
  void reset()
  {
    this->Changes.reset(4);
    this->Bytes[0].reset(256);
    this->Bytes[1] = this->Bytes[0];
  }

  /// Replaces the last bytes by the next ones.
  void decode(RangeDecoder& decoder, std::uint8_t* bytes)
  {
    const unsigned changes = decoder.symbol(this->Changes);
    for (std::size_t i = 0; i < 2; ++i)
    {
      if (changes & (1U << i))
      {
        bytes[i] = std::uint8_t(bytes[i] + decoder.symbol(this->Bytes[i]));
      }
    }
  }

  void encode(RangeEncoder& encoder, const std::uint8_t* last, const std::uint8_t* next)
  {
    const unsigned changes = (last[0] != next[0] ? 1U : 0U) | (last[1] != next[1] ? 2U : 0U);
    encoder.symbol(this->Changes, changes);
    for (std::size_t i = 0; i < 2; ++i)
    {
      if (changes & (1U << i))
      {
        encoder.symbol(this->Bytes[i], unsigned(next[i] - last[i]) & 255U);
      }
    }
  }

private:
  SymbolModel<4> Changes;
  std::array<SymbolModel<256>, 2> Bytes;
};

/// The models of extra bytes, one for each.
struct ByteModels
{
  void reset(std::size_t count)
  {
    this->Models.resize(count);
    this->Models[0].reset(256);
    std::fill(this->Models.begin() + 1, this->Models.end(), this->Models[0]);
  }

  std::vector<SymbolModel<256>> Models;
};

/// 1: the first return, 2: the last one, 3: both.
inline unsigned lastPlaces(std::uint8_t returns)
{
  constexpr std::array<std::uint8_t, 4> swapped = { 0, 2, 1, 3 };
  return swapped[contexts14.Place[returns]];
}

/// The context of a class: the last one, and whether the point is the single return.
inline unsigned contextOfClass(const LastPoint14& last)
{
  return (last.LastClass & 31U) * 2 + (contexts14.Place[last.LastReturns] == 3 ? 1 : 0);
}

} // namespace tipp

#endif
