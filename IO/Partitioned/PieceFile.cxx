// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceFile.h"

#include "Files/IOError.h"
#include "Files/RawArray.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace tipp
{

GlobalIdMap::GlobalIdMap(const std::int64_t* ids, const std::int64_t* values, std::size_t count)
{
  if (count == 0)
  {
    return;
  }
  constexpr std::uint64_t limit = std::numeric_limits<std::uint32_t>::max();
  if (count > limit)
  {
    throw std::length_error("a piece has more than 2^32 points; cut the mesh into more pieces");
  }
  this->Least = ids[0];
  this->Range = std::uint64_t(ids[count - 1]) - std::uint64_t(ids[0]);
  while ((this->Range >> this->Shift) >= 2 * count)
  {
    ++this->Shift;
  }
  std::uint64_t greatest = count;
  for (std::size_t i = 0; values && i < count; ++i)
  {
    greatest = std::max(greatest, std::uint64_t(values[i]));
  }
  const bool isNarrow = this->Range <= limit && greatest <= limit;
  isNarrow ? this->fill(this->Narrow, ids, values, count)
           : this->fill(this->Wide, ids, values, count);
}

template <typename Number>
void GlobalIdMap::fill(std::vector<IdValue<Number>>& entries, const std::int64_t* ids,
  const std::int64_t* values, std::size_t count)
{
  entries.resize(count);
  this->Starts.assign(std::size_t(this->Range >> this->Shift) + 2, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint64_t key = std::uint64_t(ids[i]) - std::uint64_t(this->Least);
    entries[i] = { Number(key), Number(values ? std::uint64_t(values[i]) : i) };
    ++this->Starts[std::size_t(key >> this->Shift) + 1];
  }
  for (std::size_t i = 1; i < this->Starts.size(); ++i)
  {
    this->Starts[i] += this->Starts[i - 1];
  }
}

template <typename Number>
std::int64_t GlobalIdMap::search(
  const std::vector<IdValue<Number>>& entries, std::uint64_t key) const
{
  if (key > this->Range || entries.empty())
  {
    return -1;
  }
  const std::size_t slot = std::size_t(key >> this->Shift);
  std::uint32_t from = this->Starts[slot];
  std::uint32_t to = this->Starts[slot + 1];
  // If ids are dense in one part of the range and sparse in another, many may share an entry.
  while (to - from > 8)
  {
    const std::uint32_t middle = from + (to - from) / 2;
    (entries[middle].Id <= key ? from : to) = middle;
  }
  for (; from < to; ++from)
  {
    if (entries[from].Id == key)
    {
      return std::int64_t(entries[from].Value);
    }
  }
  return -1;
}

std::int64_t GlobalIdMap::find(std::int64_t id) const
{
  const std::uint64_t key = std::uint64_t(id) - std::uint64_t(this->Least);
  return this->Wide.empty() ? this->search(this->Narrow, key) : this->search(this->Wide, key);
}

template <typename Value>
bool GlobalIdMap::translate(const std::int64_t* ids, std::size_t count, Value* values) const
{
  std::int64_t all = 0;
  const auto run = [&](const auto& entries)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint64_t key = std::uint64_t(ids[i]) - std::uint64_t(this->Least);
      const std::int64_t value = this->search(entries, key);
      all |= value;
      values[i] = Value(value);
    }
  };
  this->Wide.empty() ? run(this->Narrow) : run(this->Wide);
  return all >= 0;
}

template VTKTIPPIO_EXPORT bool GlobalIdMap::translate(
  const std::int64_t*, std::size_t, std::int32_t*) const;
template VTKTIPPIO_EXPORT bool GlobalIdMap::translate(
  const std::int64_t*, std::size_t, std::int64_t*) const;

namespace
{

/// Bytes that are read at a time, so that they are still in the cache when they are verified.
constexpr std::size_t blockBytes = std::size_t(1) << 18;

} // namespace

PieceFile::PieceFile(const PartitionedMesh& mesh, std::size_t number)
  : PieceFile(mesh, number, mesh.Pieces[number], readPieceTable(mesh, number))
{
  this->BytesRead += std::int64_t(this->Summary.TableBytes);
}

PieceFile::PieceFile(
  const PartitionedMesh& mesh, std::size_t number, const PieceSummary& summary, PieceTable table)
  : Summary(summary)
  , Number(number)
  , File(mesh.piecePath(number))
  , Table(std::move(table))
  , Arrays(pieceArrays(mesh, this->Summary))
  , PointParts(this->Table.partStarts(mesh, this->Summary, true))
  , CellParts(this->Table.partStarts(mesh, this->Summary, false))
{
  this->OfAttribute.assign(mesh.Arrays.size(), this->Arrays.size());
  for (std::size_t i = 0; i < this->Arrays.size(); ++i)
  {
    if (this->Arrays[i].Attribute >= 0)
    {
      this->OfAttribute[std::size_t(this->Arrays[i].Attribute)] = i;
    }
  }
  std::string header(std::size_t(this->Table.HeaderBytes), '\0');
  this->File.read(0, header.data(), header.size());
  this->BytesRead += std::int64_t(header.size());
  if (checksumOf(header.data(), header.size()) != this->Table.HeaderChecksum)
  {
    this->fail("its header does not have the checksum of piece " + std::to_string(this->Number));
  }
}

void PieceFile::fail(const std::string& problem) const
{
  throw IOError(this->File.path(), problem + "; copy or make the mesh again.");
}

void PieceFile::requireIds(const std::int64_t* ids, std::size_t count, std::int64_t limit) const
{
  if (!areBelow(ids, count, limit))
  {
    this->fail("holds a global id that the mesh does not have");
  }
}

/// Reads whole tuples to blockAt(byte), calls take(byte, bytes) and verifies them, until that
/// returns false.
template <typename BlockAt, typename Take>
void PieceFile::readBlocks(std::size_t array, std::size_t first, std::size_t end,
  const BlockAt& blockAt, const Take& take) const
{
  const PieceArray& description = this->Arrays[array];
  const std::size_t tuple = description.tupleBytes();
  const std::vector<std::int64_t>& starts = this->partStarts(description.ofPoints());
  // In bytes from the first part on.
  const auto startOf = [&](std::size_t part)
  { return std::size_t(starts[part] - starts[first]) * tuple; };
  const std::uint64_t offset = this->Table.Offsets[array] + std::uint64_t(starts[first]) * tuple;
  const std::size_t bytes = startOf(end);
  const std::size_t step = std::max(blockBytes / tuple, std::size_t(1)) * tuple;
  Checksum sum; // checksum of the part that began in an earlier block
  std::size_t hashed = 0;
  std::size_t part = first;
  for (std::size_t begin = 0; begin < bytes; begin += step)
  {
    const std::size_t blockEnd = std::min(begin + step, bytes);
    char* const block = blockAt(begin);
    this->File.read(offset + begin, block, blockEnd - begin);
    if (!take(begin, blockEnd - begin))
    {
      return;
    }
    for (; part < end && startOf(part + 1) <= blockEnd; hashed = startOf(++part))
    {
      const char* const data = block + (hashed - begin);
      const std::size_t size = startOf(part + 1) - hashed;
      if (hashed == startOf(part))
      {
        this->requirePart(array, part, checksumOf(data, size));
        continue;
      }
      sum.add(data, size);
      this->requirePart(array, part, sum.finish());
    }
    sum.add(block + (hashed - begin), blockEnd - hashed);
    hashed = blockEnd;
  }
  for (; part < end; ++part) // there are no tuples
  {
    this->requirePart(array, part, checksumOf(nullptr, 0));
  }
  this->BytesRead += std::int64_t(bytes);
}

void PieceFile::read(std::size_t array, std::size_t first, std::size_t end, void* to) const
{
  const std::size_t tuple = this->Arrays[array].tupleBytes();
  Buffer<char> unused(to ? 0 : std::max(blockBytes, tuple));
  this->readBlocks(
    array, first, end,
    [&](std::size_t begin) { return to ? static_cast<char*>(to) + begin : unused.data(); },
    [](std::size_t, std::size_t) { return true; });
}

void PieceFile::visit(
  std::size_t array, std::size_t first, std::size_t end, const TakeTuples& take) const
{
  const std::size_t tuple = this->Arrays[array].tupleBytes();
  Buffer<char> block(std::max(blockBytes, tuple));
  this->readBlocks(
    array, first, end, [&](std::size_t) { return block.data(); },
    [&](std::size_t begin, std::size_t bytes)
    { return take(std::int64_t(begin / tuple), std::int64_t(bytes / tuple), block.data()); });
}

void PieceFile::requirePart(std::size_t array, std::size_t part, std::uint64_t checksum) const
{
  if (checksum != this->Table.Checksums[array][part])
  {
    this->fail("the array " + this->Arrays[array].Name + " does not have its checksum");
  }
}

void PieceFile::requireZeros(std::uint64_t from, std::uint64_t to) const
{
  this->File.readBlocks(from, to - from,
    [this](const char* data, std::size_t bytes)
    {
      if (std::any_of(data, data + bytes, [](char byte) { return byte != 0; }))
      {
        this->fail("holds something between its arrays");
      }
    });
}

void PieceFile::verifyAll() const
{
  if (this->File.size() != this->Summary.FileBytes)
  {
    this->fail("has " + std::to_string(this->File.size()) + " bytes instead of " +
      std::to_string(this->Summary.FileBytes));
  }
  std::uint64_t at = this->Table.HeaderBytes;
  for (std::size_t a = 0; a < this->Arrays.size(); ++a)
  {
    const PieceArray& array = this->Arrays[a];
    const std::uint64_t offset = this->Table.Offsets[a];
    const std::vector<std::int64_t>& starts = this->partStarts(array.ofPoints());
    const std::uint64_t bytes = std::uint64_t(starts.back()) * array.tupleBytes();
    std::uint64_t written = 0;
    if (offset < at + sizeof(written))
    {
      this->fail("the array " + array.Name + " is not behind the one before it");
    }
    this->requireZeros(at, offset - sizeof(written));
    this->File.read(offset - sizeof(written), &written, sizeof(written));
    if (written != bytes)
    {
      this->fail("the array " + array.Name + " does not have its size before it");
    }
    if (!this->Table.Checksums[a].empty())
    {
      this->read(a, 0, starts.size() - 1, nullptr);
    }
    at = offset + bytes;
  }
  const std::uint64_t end = this->Summary.FileBytes - std::strlen(pieceFooter);
  if (end < at)
  {
    this->fail("ends before its arrays do");
  }
  this->requireZeros(at, end);
  std::string footer(std::strlen(pieceFooter), '\0');
  this->File.read(end, footer.data(), footer.size());
  if (footer != pieceFooter)
  {
    this->fail("does not end as it was written");
  }
}

ColumnWriter::ColumnWriter(const OutputFile& file, std::uint64_t offset, std::size_t bufferBytes)
  : File(file)
  , Offset(offset)
  , Unwritten(bufferBytes)
{
}

char* ColumnWriter::extend(std::size_t bytes)
{
  if (this->Used + bytes > this->Unwritten.size())
  {
    this->flush();
    if (bytes > this->Unwritten.size())
    {
      this->Unwritten = Buffer<char>(bytes);
    }
  }
  char* const room = this->Unwritten.data() + this->Used;
  this->Used += bytes;
  return room;
}

void ColumnWriter::endPart()
{
  this->Part.add(this->Unwritten.data() + this->Hashed, this->Used - this->Hashed);
  this->Hashed = this->Used;
  this->Checksums.push_back(this->Part.finish());
}

void ColumnWriter::flush()
{
  this->Part.add(this->Unwritten.data() + this->Hashed, this->Used - this->Hashed);
  this->File.write(this->Offset, this->Unwritten.data(), this->Used);
  this->Offset += this->Used;
  this->Used = 0;
  this->Hashed = 0;
}

std::uint64_t writeFrame(const OutputFile& file, const PieceLayout& layout, PieceTable& table)
{
  file.write(0, layout.Header.data(), layout.Header.size());
  const std::size_t footer = std::strlen(pieceFooter);
  file.write(layout.End, pieceFooter, footer);
  file.startWriteback();
  table.Offsets = layout.Offsets;
  table.HeaderBytes = layout.Header.size();
  table.HeaderChecksum = checksumOf(layout.Header.data(), layout.Header.size());
  return layout.End + footer;
}

PieceWriter::PieceWriter(const PartitionedMesh& mesh, std::size_t number,
  const PieceSummary& summary, std::size_t bufferBytes)
  : Layout(layOutPiece(mesh, number, summary))
  , File(mesh.piecePath(number))
{
  for (std::size_t a = 0; a < this->Layout.Arrays.size(); ++a)
  {
    const PieceArray& array = this->Layout.Arrays[a];
    const std::uint64_t bytes =
      std::uint64_t(storedTuples(mesh, summary, array.ofPoints())) * array.tupleBytes();
    this->File.write(this->Layout.Offsets[a] - 8, &bytes, 8);
    this->Columns.emplace_back(this->File, this->Layout.Offsets[a], bufferBytes);
  }
}

void PieceWriter::endPart(bool ofPoints)
{
  for (std::size_t a = 0; a < this->Columns.size(); ++a)
  {
    if (this->Layout.Arrays[a].ofPoints() == ofPoints)
    {
      this->Columns[a].endPart();
    }
  }
}

std::uint64_t PieceWriter::finish(PieceTable& table)
{
  for (ColumnWriter& column : this->Columns)
  {
    column.flush();
    table.Checksums.push_back(std::move(column.checksums()));
  }
  return writeFrame(this->File, this->Layout, table);
}

} // namespace tipp
