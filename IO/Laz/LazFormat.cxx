// SPDX-License-Identifier: BSD-3-Clause
#include "Laz/LazFormat.h"

#include "Files/RawValues.h"
#include "Laz/IntegerCoder.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

/// Returns the size of an item of a known kind, 0 if any size is good.
std::size_t sizeOf(LazItem::Kind kind)
{
  switch (kind)
  {
    case LazItem::Kind::Point10:
      return 20;
    case LazItem::Kind::Time11:
    case LazItem::Kind::ColourInfrared14:
      return 8;
    case LazItem::Kind::Colour12:
    case LazItem::Kind::Colour14:
      return 6;
    case LazItem::Kind::Wave13:
    case LazItem::Kind::Wave14:
      return 29;
    case LazItem::Kind::Point14:
      return 30;
    default:
      return 0;
  }
}

bool isLayered(LazItem::Kind kind)
{
  return kind >= LazItem::Kind::Point14;
}

bool isKnownVersion(const LazItem& item)
{
  if (isLayered(item.What))
  {
    return item.Version >= 2 && item.Version <= 4; // 2: the prototype of 3, and the same
  }
  // Wave packets have one version, which some writers call 2.
  return item.Version == 2 || (item.What == LazItem::Kind::Wave13 && item.Version == 1);
}

LazItem readItem(const std::uint8_t* bytes, std::size_t offset)
{
  LazItem item;
  const auto kind = valueAt<std::uint16_t>(bytes);
  item.What = LazItem::Kind(kind);
  item.Size = valueAt<std::uint16_t>(bytes + 2);
  item.Version = valueAt<std::uint16_t>(bytes + 4);
  item.Offset = offset;
  const bool isKnown = kind == 0 || (kind >= 6 && kind <= 14);
  const std::size_t size = sizeOf(item.What);
  if (!isKnown || item.Size == 0 || (size > 0 && item.Size != size))
  {
    throw LazError("has compressed items of kind " + std::to_string(kind) + " and " +
      std::to_string(item.Size) + " bytes, which are not known here");
  }
  if (item.Version == 1 && !isLayered(item.What) && item.What != LazItem::Kind::Wave13)
  {
    throw LazError("is compressed as LASzip 1 did until 2010, which is not read here; decompress "
                   "it with a LASzip of today");
  }
  if (!isKnownVersion(item))
  {
    throw LazError("has items of kind " + std::to_string(kind) + " compressed by version " +
      std::to_string(item.Version) + ", which is not known here");
  }
  return item;
}

constexpr std::size_t fixedPart = 34; ///< of the record of the compression
constexpr std::size_t itemPart = 6;

} // namespace

LazFormat::LazFormat(const std::uint8_t* content, std::size_t size)
{
  if (size < fixedPart)
  {
    throw LazError("has a damaged record of its compression");
  }
  const auto compressor = valueAt<std::uint16_t>(content);
  const auto coder = valueAt<std::uint16_t>(content + 2);
  const std::size_t items = valueAt<std::uint16_t>(content + 32);
  if (compressor < 1 || compressor > 3 || coder != 0)
  {
    throw LazError("is compressed by method " + std::to_string(compressor) + " with coder " +
      std::to_string(coder) + ", which is not known here");
  }
  if (items == 0 || size < fixedPart + items * itemPart)
  {
    throw LazError("has a damaged record of its compression");
  }
  this->IsChunked = compressor != 1;
  this->IsLayered = compressor == 3;
  // Some writers state variable chunks as 0.
  const auto points = valueAt<std::uint32_t>(content + 12);
  this->ChunkPoints = points == 0 ? VariableChunks : points;
  for (std::size_t i = 0; i < items; ++i)
  {
    this->Items.push_back(readItem(content + fixedPart + i * itemPart, this->RecordLength));
    this->RecordLength += this->Items.back().Size;
    if (isLayered(this->Items.back().What) != this->IsLayered)
    {
      throw LazError("has items of kind " + std::to_string(int(this->Items.back().What)) +
        ", which do not go with its method of compression");
    }
  }
  const LazItem::Kind first = this->IsLayered ? LazItem::Kind::Point14 : LazItem::Kind::Point10;
  const auto isPoint = [&](const LazItem& item) { return item.What == first; };
  const auto points14 = std::count_if(this->Items.begin(), this->Items.end(), isPoint);
  // The layers of the other items depend on the scanner channels of the points.
  if (this->IsLayered && (points14 != 1 || this->Items.front().What != first))
  {
    throw LazError("has compressed items without points before them");
  }
  if (this->RecordLength > 0xFFFF)
  {
    throw LazError("has compressed records of " + std::to_string(this->RecordLength) + " bytes");
  }
}

LazFormat LazFormat::layered(int pointFormat, std::size_t extraBytes)
{
  LazFormat format;
  format.IsChunked = true;
  format.IsLayered = true;
  format.ChunkPoints = UsualChunkPoints;
  const auto add = [&format](LazItem::Kind kind, std::size_t size)
  {
    constexpr int version = 3;
    format.Items.push_back({ kind, size, format.RecordLength, version });
    format.RecordLength += size;
  };
  add(LazItem::Kind::Point14, sizeOf(LazItem::Kind::Point14));
  if (pointFormat >= 7)
  {
    const LazItem::Kind kind =
      pointFormat == 8 ? LazItem::Kind::ColourInfrared14 : LazItem::Kind::Colour14;
    add(kind, sizeOf(kind));
  }
  if (extraBytes > 0)
  {
    add(LazItem::Kind::Bytes14, extraBytes);
  }
  return format;
}

std::vector<std::uint8_t> LazFormat::record() const
{
  std::vector<std::uint8_t> content(fixedPart + this->Items.size() * itemPart);
  setValue(&content[0], std::uint16_t(3)); // the compressor: layers in chunks
  content[4] = 3;                          // the version of LASzip whose format this is
  content[5] = 4;
  setValue(&content[6], std::uint16_t(3));
  setValue(&content[12], this->ChunkPoints);
  setValue(&content[16], std::int64_t(-1)); // special records: unknown
  setValue(&content[24], std::int64_t(-1));
  setValue(&content[32], std::uint16_t(this->Items.size()));
  std::uint8_t* at = &content[fixedPart];
  for (const LazItem& item : this->Items)
  {
    setValue(at, std::uint16_t(item.What));
    setValue(at + 2, std::uint16_t(item.Size));
    setValue(at + 4, std::uint16_t(item.Version));
    at += itemPart;
  }
  return content;
}

std::vector<std::uint8_t> writeLazChunkTable(const std::vector<std::uint32_t>& sizes)
{
  std::vector<std::uint8_t> table(8);
  setValue(&table[4], std::uint32_t(sizes.size()));
  if (sizes.empty())
  {
    return table;
  }
  RangeEncoder encoder;
  const auto integers = std::make_unique<IntegerCoder<32, 2>>();
  integers->reset();
  std::int32_t last = 0;
  for (const std::uint32_t size : sizes)
  {
    integers->encode(encoder, last, std::int32_t(size), 1);
    last = std::int32_t(size);
  }
  encoder.finish();
  table.insert(table.end(), encoder.bytes(), encoder.bytes() + encoder.size());
  return table;
}

LazChunkTable readLazChunkTable(const LazFormat& format, const std::uint8_t* table,
  std::size_t size, std::uint64_t points, std::uint64_t begin, std::uint64_t end)
{
  constexpr std::size_t header = 8;
  if (size < header || valueAt<std::uint32_t>(table) != 0)
  {
    throw LazError("has a damaged chunk table");
  }
  const std::uint64_t count = valueAt<std::uint32_t>(table + 4);
  const bool isVariable = format.ChunkPoints == LazFormat::VariableChunks;
  // Each chunk has a record at least, so that a damaged count cannot ask for much memory.
  if (count > (end - std::min(begin, end)) / std::max<std::size_t>(format.RecordLength, 1))
  {
    throw LazError("has a damaged chunk table");
  }
  RangeDecoder decoder(table + header, size - header);
  const auto integers = std::make_unique<IntegerCoder<32, 2>>();
  integers->reset();
  std::vector<LazChunkPlace> places;
  std::uint64_t left = points;
  std::int32_t lastPoints = 0;
  std::int32_t lastBytes = 0;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    lastPoints = isVariable ? integers->decode(decoder, lastPoints, 0) : 0;
    lastBytes = integers->decode(decoder, lastBytes, 1);
    LazChunkPlace place;
    place.Begin = begin;
    place.Bytes = std::uint32_t(lastBytes);
    place.FirstPoint = points - left;
    place.Points =
      std::min<std::uint64_t>(left, isVariable ? std::uint32_t(lastPoints) : format.ChunkPoints);
    if (decoder.isDamaged() || place.Bytes > end - begin)
    {
      throw LazError("has a damaged chunk table");
    }
    begin += place.Bytes;
    left -= place.Points;
    if (place.Points > 0)
    {
      places.push_back(place);
    }
  }
  if (left > 0)
  {
    throw LazError("has a chunk table without the last " + std::to_string(left) + " of its " +
      std::to_string(points) + " points");
  }
  return { std::move(places), begin };
}

} // namespace tipp
