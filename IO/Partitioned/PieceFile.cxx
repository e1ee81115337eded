// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceFile.h"

#include "Files/IOError.h"
#include "Partitioned/Checksum.h"
#include "Partitioned/IdRange.h"

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
    if (checksumOf(at, size) != this->Table.Checksums[array][part])
    {
      this->fail("the array " + description.Name + " does not have its checksum");
    }
    at += size;
  }
}

} // namespace tipp
