// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LazFile.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

template <typename T>
T valueIn(const InputFile& file, std::uint64_t offset)
{
  T value{};
  file.read(offset, &value, sizeof value);
  return value;
}

LazFormat formatOf(const std::string& path, const LasHeader& header)
{
  try
  {
    LazFormat format(
      reinterpret_cast<const std::uint8_t*>(header.Compression.data()), header.Compression.size());
    if (format.RecordLength != header.RecordLength || format.IsLayered != header.isExtended())
    {
      throw LazError("has compressed items of " + std::to_string(format.RecordLength) +
        " bytes, which do not make a point of format " + std::to_string(header.Format));
    }
    return format;
  }
  catch (const LazError& error)
  {
    throw IOError(path, std::string(error.what()) + ".");
  }
}

/// Whether chunks can be found without the table: of pointwise ones the number of points is needed.
bool canBeSearched(const LazFormat& format)
{
  return format.IsLayered || format.ChunkPoints != LazFormat::VariableChunks;
}

/// The number of points of a layered chunk is behind its first point.
std::uint64_t pointsOfLayers(const InputFile& file, const LazFormat& format, std::uint64_t begin)
{
  const std::uint64_t at = begin + format.RecordLength;
  return at + 4 <= file.size() ? valueIn<std::uint32_t>(file, at) : 0;
}

/// The chunks of a table that hold the file's points.
struct ChunksOfTable
{
  std::vector<LazChunkPlace> Chunks;
  bool HasMore = false; ///< the table or the last chunk has more points than these
};

/// Finds the chunks by the table. Throws LazError if it is damaged or missing.
ChunksOfTable chunksByTable(
  const InputFile& file, const LazFormat& format, std::uint64_t points, std::uint64_t offsetAt)
{
  constexpr std::size_t header = 8;
  constexpr std::uint64_t longestEntry = 16; // of two numbers, by far
  const std::uint64_t begin = offsetAt + header;
  if (begin > file.size())
  {
    throw LazError("has no chunk table");
  }
  auto at = valueIn<std::uint64_t>(file, offsetAt);
  if (at == ~std::uint64_t(0)) // written as a stream: the offset is at the file's end
  {
    at = valueIn<std::uint64_t>(file, file.size() - sizeof at);
  }
  if (at < begin || at > file.size() || file.size() - at < header)
  {
    throw LazError("has no chunk table");
  }
  const std::uint64_t count = valueIn<std::uint32_t>(file, at + 4);
  std::vector<std::uint8_t> table(
    std::size_t(std::min(file.size() - at, header + longestEntry * (count + 4))));
  file.read(at, table.data(), table.size());
  LazChunkTable read = readLazChunkTable(format, table.data(), table.size(), points, begin, at);
  // The table follows the last chunk.
  if (read.End != at && canBeSearched(format))
  {
    throw LazError("has a damaged chunk table");
  }
  const LazChunkPlace& last = read.Chunks.back();
  const bool hasMore = last.Begin + last.Bytes != read.End ||
    (format.IsLayered && pointsOfLayers(file, format, last.Begin) > last.Points);
  return { std::move(read.Chunks), hasMore };
}

/// Returns the most bytes that a chunk of this many points may have.
std::uint64_t mostBytes(const LazFormat& format, std::uint64_t points)
{
  constexpr std::uint64_t besides = 1 << 16;
  return 2 * format.RecordLength * std::min(points, std::uint64_t(1) << 44) + besides;
}

/// Returns the number of bytes of a chunk, by decoding it. Throws LazError.
std::uint64_t bytesOf(
  const InputFile& file, const LazFormat& format, const LazChunkPlace& place, LazChunk& chunk)
{
  constexpr std::uint64_t step = 4096;
  std::vector<std::uint8_t> bytes(std::size_t(place.Bytes));
  file.read(place.Begin, bytes.data(), bytes.size());
  chunk.begin(bytes.data(), bytes.size());
  // Layers state their sizes.
  std::vector<std::uint8_t> records(std::size_t(step) * format.RecordLength);
  for (std::uint64_t left = format.IsLayered ? 0 : place.Points; left > 0;)
  {
    const std::uint64_t count = std::min(step, left);
    chunk.read(std::size_t(count), records.data());
    left -= count;
  }
  return std::min<std::uint64_t>(chunk.position(), place.Bytes);
}

/// Finds the chunks without a table. A chunk that cannot be decoded is the last one.
std::vector<LazChunkPlace> chunksBySearch(
  const InputFile& file, const LazFormat& format, std::uint64_t points, std::uint64_t begin)
{
  const bool isVariable = format.ChunkPoints == LazFormat::VariableChunks;
  if (!canBeSearched(format))
  {
    throw LazError("has chunks of different sizes and a damaged chunk table, without which they "
                   "cannot be found; copy it again");
  }
  std::vector<LazChunkPlace> chunks;
  LazChunk chunk(format, 0);
  for (std::uint64_t done = 0; done < points; done += chunks.back().Points)
  {
    const std::uint64_t left = points - done;
    const std::uint64_t count =
      isVariable ? pointsOfLayers(file, format, begin) : format.ChunkPoints;
    LazChunkPlace& place = chunks.emplace_back();
    place.Begin = std::min(begin, file.size());
    place.FirstPoint = done;
    place.Points = count > 0 ? std::min(count, left) : left;
    place.Bytes = std::min(file.size() - place.Begin, mostBytes(format, place.Points));
    try
    {
      begin += place.Bytes = bytesOf(file, format, place, chunk);
    }
    catch (const LazError&)
    {
      place.Points = left;
    }
  }
  return chunks;
}

} // namespace

LazFile::LazFile(const std::string& path, const LasHeader& header)
  : Path(path)
  , Format(formatOf(path, header))
{
  const auto points = std::uint64_t(header.Points);
  if (points == 0)
  {
    return;
  }
  const InputFile file(path);
  if (!this->Format.IsChunked)
  {
    const std::uint64_t bytes =
      std::min(file.size() - header.PointOffset, mostBytes(this->Format, points));
    this->Chunks.push_back({ header.PointOffset, bytes, 0, points });
    return;
  }
  try
  {
    ChunksOfTable found = chunksByTable(file, this->Format, points, header.PointOffset);
    this->Chunks = std::move(found.Chunks);
    this->Remark = found.HasMore
      ? "announces " + std::to_string(points) + " points and has more, which are not read"
      : "";
    return;
  }
  catch (const LazError& error)
  {
    this->Remark = std::string(error.what()) + "; its chunks were found by decoding them in turn";
  }
  try
  {
    this->Chunks =
      chunksBySearch(file, this->Format, points, header.PointOffset + sizeof(std::uint64_t));
  }
  catch (const LazError& error)
  {
    throw IOError(path, std::string(error.what()) + ".");
  }
}

void LazFile::keep(const std::vector<bool>& isKept)
{
  this->All = this->Chunks.size();
  for (std::size_t i = 0; i < this->All; ++i)
  {
    if (isKept[i])
    {
      this->Chunks[this->Numbers.size()] = this->Chunks[i];
      this->Numbers.push_back(i);
    }
  }
  this->Chunks.resize(this->Numbers.size());
}

std::string LazFile::numberOf(std::size_t chunk) const
{
  const std::size_t number = this->Numbers.empty() ? chunk : this->Numbers[chunk];
  const std::size_t all = this->Numbers.empty() ? this->Chunks.size() : this->All;
  return std::to_string(number + 1) + " of " + std::to_string(all);
}

void LazReader::begin(const InputFile& file, std::size_t chunk)
{
  const LazChunkPlace& place = this->Laz.chunks()[chunk];
  this->Chunk = chunk;
  this->Bytes.resize(std::size_t(place.Bytes));
  file.read(place.Begin, this->Bytes.data(), this->Bytes.size());
  try
  {
    this->Decoder.begin(this->Bytes.data(), this->Bytes.size());
  }
  catch (const LazError& error)
  {
    this->refuse(error);
  }
}

void LazReader::read(std::size_t count, char* records)
{
  try
  {
    this->Decoder.read(count, reinterpret_cast<std::uint8_t*>(records));
  }
  catch (const LazError& error)
  {
    this->refuse(error);
  }
}

void LazReader::readWith(LazReader& other, std::size_t count, char* records, char* otherRecords)
{
  this->Decoder.readWith(other.Decoder, count, reinterpret_cast<std::uint8_t*>(records),
    reinterpret_cast<std::uint8_t*>(otherRecords));
}

void LazReader::refuse(const LazError& error) const
{
  throw IOError(this->Laz.path(),
    "cannot be decompressed: chunk " + this->Laz.numberOf(this->Chunk) + " " + error.what() +
      "; copy it again, or read the chunks before it with --keep truncated.");
}

} // namespace tipp
