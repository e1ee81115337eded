// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceFile.h"

#include "Files/IOError.h"
#include "Partitioned/Checksum.h"
#include "Partitioned/IdRange.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

std::vector<std::int64_t> startsOf(const std::vector<std::int64_t>& counts)
{
  std::vector<std::int64_t> starts{ 0 };
  for (const std::int64_t count : counts)
  {
    starts.push_back(starts.back() + count);
  }
  return starts;
}

} // namespace

PieceFile::PieceFile(const PartitionedMesh& mesh, std::size_t number, ReadCounters& counters)
  : PieceFile(mesh, number, mesh.Pieces[number], readPieceTable(mesh, number), counters)
{
  ++this->Counters.Reads;
  this->Counters.Bytes += std::int64_t(this->Summary.TableBytes);
}

PieceFile::PieceFile(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& summary,
  PieceTable table, ReadCounters& counters)
  : Summary(summary)
  , Number(number)
  , File(mesh.piecePath(number))
  , Table(std::move(table))
  , Arrays(pieceArrays(mesh, this->Summary))
  , PointParts(startsOf(this->Table.parts(mesh, this->Summary, true)))
  , CellParts(startsOf(this->Table.parts(mesh, this->Summary, false)))
  , Counters(counters)
{
  this->checkHeader();
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

void PieceFile::checkHeader() const
{
  std::string header(std::size_t(this->Table.HeaderBytes), '\0');
  this->File.read(0, header.data(), header.size());
  ++this->Counters.Reads;
  this->Counters.Bytes += std::int64_t(header.size());
  if (checksumOf(header.data(), header.size()) != this->Table.HeaderChecksum)
  {
    this->fail("its header does not have the checksum of piece " + std::to_string(this->Number));
  }
}

std::size_t PieceFile::find(PieceRole role) const
{
  std::size_t array = 0;
  while (array < this->Arrays.size() && this->Arrays[array].Role != role)
  {
    ++array;
  }
  return array;
}

std::size_t PieceFile::findAttribute(std::size_t attribute) const
{
  std::size_t array = 0;
  while (array < this->Arrays.size() && this->Arrays[array].Attribute != std::int64_t(attribute))
  {
    ++array;
  }
  return array;
}

void PieceFile::read(std::size_t array, std::size_t first, std::size_t end, void* to) const
{
  const PieceArray& description = this->Arrays[array];
  const std::vector<std::int64_t>& starts = this->partStarts(description.ofPoints());
  const std::size_t tuple = description.tupleBytes();
  const std::size_t bytes = std::size_t(starts[end] - starts[first]) * tuple;
  this->File.read(this->Table.Offsets[array] + std::uint64_t(starts[first]) * tuple, to, bytes);
  ++this->Counters.Reads;
  this->Counters.Bytes += std::int64_t(bytes);
  const char* at = static_cast<const char*>(to);
  for (std::size_t part = first; part < end; ++part)
  {
    const std::size_t size = std::size_t(starts[part + 1] - starts[part]) * tuple;
    this->requirePart(array, part, checksumOf(at, size));
    at += size;
  }
}

void PieceFile::requirePart(std::size_t array, std::size_t part, std::uint64_t checksum) const
{
  if (checksum != this->Table.Checksums[array][part])
  {
    this->fail("the array " + this->Arrays[array].Name + " does not have its checksum");
  }
}

void PieceFile::verify(std::size_t array, std::size_t first, std::size_t end) const
{
  const std::vector<std::int64_t>& starts = this->partStarts(this->Arrays[array].ofPoints());
  const std::size_t tuple = this->Arrays[array].tupleBytes();
  const auto placeOf = [&](std::size_t part)
  { return this->Table.Offsets[array] + std::uint64_t(starts[part]) * tuple; };
  std::size_t part = first;
  Checksum sum;
  // One pass over all parts, because there may be many small ones.
  const std::uint64_t bytes = placeOf(end) - placeOf(first);
  ++this->Counters.Reads;
  this->Counters.Bytes += std::int64_t(bytes);
  this->File.readBlocks(placeOf(first), bytes,
    [&, at = placeOf(first)](const char* data, std::size_t size) mutable
    {
      const std::uint64_t blockEnd = at + size;
      for (; part < end && placeOf(part + 1) <= blockEnd; ++part)
      {
        const auto rest = std::size_t(placeOf(part + 1) - at);
        sum.add(data, rest);
        this->requirePart(array, part, sum.finish());
        data += rest;
        at += rest;
      }
      sum.add(data, std::size_t(blockEnd - at));
      at = blockEnd;
    });
  for (; part < end; ++part) // the last parts may have no tuples
  {
    this->requirePart(array, part, sum.finish());
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

void PieceFile::requireFooter(std::uint64_t at) const
{
  std::string footer(std::strlen(pieceFooter), '\0');
  this->File.read(at, footer.data(), footer.size());
  if (footer != pieceFooter)
  {
    this->fail("does not end as it was written");
  }
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
      this->verify(a, 0, starts.size() - 1);
    }
    at = offset + bytes;
  }
  const std::uint64_t end = this->Summary.FileBytes - std::strlen(pieceFooter);
  if (end < at)
  {
    this->fail("ends before its arrays do");
  }
  this->requireZeros(at, end);
  this->requireFooter(end);
}

} // namespace tipp
