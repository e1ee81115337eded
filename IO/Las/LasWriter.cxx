// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasWriter.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"
#include "Las/LasHeader.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace tipp
{
namespace
{

constexpr std::size_t writtenHeader = 375; ///< header size of version 1.4

/// The number of chunks to compress together. Those of long records take much memory, so fewer:
/// records as long as 1 kB take the most.
std::size_t chunksAtOnce(int threads, std::size_t recordLength)
{
  constexpr std::size_t chunksOfThread = 2; // so that threads rarely wait for each other
  constexpr std::size_t usualLength = 1024;
  const std::size_t most = chunksOfThread * std::size_t(threads);
  return recordLength <= usualLength ? most
                                     : std::max<std::size_t>(1, most * usualLength / recordLength);
}

template <typename T>
void putAt(std::string& bytes, std::size_t at, T value)
{
  setValue(&bytes[at], value);
}

/// Returns a variable length record.
std::string variableRecord(
  const std::string& path, const std::string& user, int id, const std::string& content)
{
  constexpr std::size_t header = 54;
  if (content.size() > std::numeric_limits<std::uint16_t>::max())
  {
    throw IOError(path,
      "would have a record of " + std::to_string(content.size()) + " bytes (" + user + " " +
        std::to_string(id) +
        "), and a LAS file has room for 65535; write other points or fewer "
        "columns.");
  }
  std::string record(header, '\0');
  record.replace(2, user.size(), user);
  putAt(record, 18, std::uint16_t(id));
  putAt(record, 20, std::uint16_t(content.size()));
  return record + content;
}

} // namespace

void LasWriter::Chunk::survey(std::size_t count, const std::uint8_t* records, std::size_t length)
{
  this->Low.fill(std::numeric_limits<std::int32_t>::max());
  this->High.fill(std::numeric_limits<std::int32_t>::min());
  this->Returns.fill(0);
  for (; count > 0; --count, records += length)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto coordinate = valueAt<std::int32_t>(records + 4 * axis);
      this->Low[axis] = std::min(this->Low[axis], coordinate);
      this->High[axis] = std::max(this->High[axis], coordinate);
    }
    ++this->Returns[records[14] & 15U];
  }
}

void LasWriter::Chunk::add(const Chunk& other)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Low[axis] = std::min(this->Low[axis], other.Low[axis]);
    this->High[axis] = std::max(this->High[axis], other.High[axis]);
  }
  for (std::size_t i = 0; i < this->Returns.size(); ++i)
  {
    this->Returns[i] += other.Returns[i];
  }
}

LasWriter::LasWriter(const std::string& path, const LasLayout& layout, int threads,
  const std::optional<PathState>& before)
  : Path(path)
  , Layout(layout)
  , IsCompressed(extensionOf(path) == ".laz")
  , Threads(threadCount(threads))
  , Format(LazFormat::layered(layout.Format, layout.ExtraBytes))
  , VariableRecords(this->recordsOfHeader(path))
  , Pending(path, before)
  , End(writtenHeader + this->VariableRecords.size())
{
  if (this->Format.RecordLength > std::numeric_limits<std::uint16_t>::max())
  {
    throw IOError(path,
      "would have points of " + std::to_string(this->Format.RecordLength) +
        " bytes, and a LAS file has room for 65535; write fewer columns.");
  }
  this->Chunks.resize(chunksAtOnce(this->Threads, this->Format.RecordLength));
  for (int i = 0; this->IsCompressed && i < this->Threads; ++i)
  {
    this->Encoders.emplace_back(this->Format);
  }
  this->All.survey(0, nullptr, 0);
  this->End += this->IsCompressed ? sizeof(std::uint64_t) : 0; // where the chunk table is
}

std::size_t LasWriter::makeRoom(std::size_t most, std::uint8_t*& records)
{
  const std::size_t capacity = this->Chunks.size() * LazFormat::UsualChunkPoints;
  if (this->Waiting == capacity)
  {
    this->flush();
  }
  const std::size_t length = this->Format.RecordLength;
  const std::size_t count = std::min(most, capacity - this->Waiting);
  this->Records.resize(std::max(this->Records.size(), (this->Waiting + count) * length));
  records = this->Records.data() + this->Waiting * length;
  return count;
}

/// Writes the waiting records. All chunks but the last one of the file are whole, since no others
/// are flushed before.
void LasWriter::flush()
{
  constexpr std::size_t chunkPoints = LazFormat::UsualChunkPoints;
  const std::size_t length = this->Format.RecordLength;
  const std::size_t chunks = (this->Waiting + chunkPoints - 1) / chunkPoints;
  forChunks(std::int64_t(chunks), 1, this->Threads, {},
    [&](std::int64_t i, std::int64_t, int thread)
    {
      Chunk& chunk = this->Chunks[std::size_t(i)];
      const std::size_t first = std::size_t(i) * chunkPoints;
      const std::size_t count = std::min(chunkPoints, this->Waiting - first);
      const std::uint8_t* const records = &this->Records[first * length];
      chunk.survey(count, records, length);
      if (this->IsCompressed)
      {
        chunk.Bytes.clear();
        this->Encoders[std::size_t(thread)].encode(count, records, chunk.Bytes);
      }
    });
  if (!this->IsCompressed)
  {
    this->write(this->Records.data(), this->Waiting * length);
  }
  for (std::size_t i = 0; i < chunks; ++i)
  {
    const Chunk& chunk = this->Chunks[i];
    this->All.add(chunk);
    if (this->IsCompressed)
    {
      this->Sizes.push_back(this->sizeOf(chunk));
      this->write(chunk.Bytes.data(), chunk.Bytes.size());
    }
  }
  this->Points += this->Waiting;
  this->Waiting = 0;
}

/// Returns the bytes of a chunk. The chunk table has 32 bits for them, which hold any chunk of
/// plain records, but compression may lengthen records of contrived bytes.
std::uint32_t LasWriter::sizeOf(const Chunk& chunk) const
{
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  constexpr std::uint64_t longestRecord = std::numeric_limits<std::uint16_t>::max();
  static_assert(LazFormat::UsualChunkPoints * longestRecord <= most, "plain records fit");
  if (chunk.Bytes.size() > most)
  {
    throw IOError(this->Path,
      "would have a chunk of " + std::to_string(chunk.Bytes.size()) +
        " bytes, and a LAZ file has room for " + std::to_string(most) + "; write a .las file.");
  }
  return std::uint32_t(chunk.Bytes.size());
}

void LasWriter::write(const void* from, std::size_t bytes)
{
  this->Pending.file().write(this->End, from, bytes);
  this->End += bytes;
}

void LasWriter::close()
{
  this->flush();
  const OutputFile& file = this->Pending.file();
  const std::string start = this->header() + this->VariableRecords;
  file.write(0, start.data(), start.size());
  if (this->IsCompressed)
  {
    const std::uint64_t tableAt = this->End;
    file.write(start.size(), &tableAt, sizeof tableAt);
    const std::vector<std::uint8_t> table = writeLazChunkTable(this->Sizes);
    this->write(table.data(), table.size());
  }
  this->Pending.commit();
}

std::string LasWriter::recordsOfHeader(const std::string& path)
{
  std::string all;
  const auto add = [&](const char* user, int id, const std::string& content)
  {
    if (!content.empty())
    {
      all += variableRecord(path, user, id, content);
      ++this->RecordCount;
    }
  };
  const CrsRecords& crs = this->Layout.Crs;
  add("LASF_Projection", 2112, crs.Text.empty() ? "" : crs.Text + '\0');
  add("LASF_Projection", 34735, crs.Keys);
  add("LASF_Projection", 34736, crs.Doubles);
  add("LASF_Projection", 34737, crs.Ascii);
  add("LASF_Spec", 4, this->Layout.Descriptors);
  if (this->IsCompressed)
  {
    const std::vector<std::uint8_t> record = this->Format.record();
    add("laszip encoded", 22204, std::string(record.begin(), record.end()));
  }
  return all;
}

std::string LasWriter::header() const
{
  const LasLayout& layout = this->Layout;
  std::string header(writtenHeader, '\0');
  header.replace(0, 4, "LASF");
  // The bits of the global encoding. Without keys of GeoTIFF, the system is given by WKT.
  const bool hasWkt = layout.Crs.Keys.empty();
  putAt(header, 6,
    std::uint16_t(
      (layout.HasStandardTime ? 1 : 0) | (layout.AreReturnsSynthetic ? 8 : 0) | (hasWkt ? 16 : 0)));
  header[24] = 1;
  header[25] = 4;
  constexpr std::size_t longest = 32;
  header.replace(26, std::min(layout.System.size(), longest), layout.System, 0, longest);
  header.replace(58, std::min(layout.Software.size(), longest), layout.Software, 0, longest);
  // The date stays 0, so that equal points give equal files.
  putAt(header, 94, std::uint16_t(writtenHeader));
  putAt(header, 96, std::uint32_t(writtenHeader + this->VariableRecords.size()));
  putAt(header, 100, std::uint32_t(this->RecordCount));
  putAt(header, 104, std::uint8_t(layout.Format | (this->IsCompressed ? 128 : 0)));
  putAt(header, 105, std::uint16_t(this->Format.RecordLength));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double scale = layout.Scale[axis];
    const double offset = layout.Offset[axis];
    putAt(header, 131 + 8 * axis, scale);
    putAt(header, 155 + 8 * axis, offset);
    if (this->Points > 0)
    {
      const double low = this->All.Low[axis] * scale + offset;
      const double high = this->All.High[axis] * scale + offset;
      putAt(header, 179 + 16 * axis, std::max(low, high)); // a scale may be below 0
      putAt(header, 187 + 16 * axis, std::min(low, high));
    }
  }
  putAt(header, 247, this->Points);
  std::memcpy(&header[255], &this->All.Returns[1], 15 * sizeof(std::uint64_t));
  return header;
}

} // namespace tipp
