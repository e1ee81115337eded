// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <stdexcept>

namespace tipp
{
namespace
{

struct ScalarInfo
{
  std::size_t Size;
  const char* Name;
  const char* Descr;
};

// In the order of the enumerators of Scalar.
constexpr ScalarInfo scalars[] = {
  { 1, "Int8", "|i1" },
  { 1, "UInt8", "|u1" },
  { 2, "Int16", "<i2" },
  { 2, "UInt16", "<u2" },
  { 4, "Int32", "<i4" },
  { 4, "UInt32", "<u4" },
  { 8, "Int64", "<i8" },
  { 8, "UInt64", "<u8" },
  { 4, "Float32", "<f4" },
  { 8, "Float64", "<f8" },
};

std::optional<Scalar> find(const char* ScalarInfo::*text, const std::string& wanted)
{
  for (std::size_t type = 0; type < std::size(scalars); ++type)
  {
    if (wanted == scalars[type].*text)
    {
      return Scalar(int(type));
    }
  }
  return std::nullopt;
}

} // namespace

std::size_t scalarSize(Scalar type)
{
  return scalars[int(type)].Size;
}

const char* scalarName(Scalar type)
{
  return scalars[int(type)].Name;
}

const char* scalarDescr(Scalar type)
{
  return scalars[int(type)].Descr;
}

std::optional<Scalar> scalarFromName(const std::string& name)
{
  return find(&ScalarInfo::Name, name);
}

std::optional<Scalar> scalarFromDescr(const std::string& descr)
{
  return find(&ScalarInfo::Descr, descr);
}

FlatMesh openFlatMesh(const std::string& path)
{
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure))
  {
    return openFlatFolder(path);
  }
  if (extensionOf(path) == ".vtu")
  {
    return openFlatVtu(path);
  }
  throw IOError(path,
    "is neither a folder of .npy arrays nor a .vtu file; 'tipp flatten' makes such a folder of any "
    "VTK file.");
}

bool isFlatMesh(const std::string& path)
{
  std::error_code failure;
  return std::filesystem::is_directory(path, failure)
    ? isFlatFolder(path)
    : extensionOf(path) == ".vtu" && isFlatVtu(path);
}

namespace
{

// A block of 32-bit ids stays in the L1 cache while it is widened.
constexpr std::int64_t blockIds = 4096;

} // namespace

CellReader::CellReader(const FlatMesh& mesh, std::int64_t first, std::int64_t last, int threads)
  : Cells(mesh.Cells)
  , Points(mesh.Points.Tuples)
  , CellSize(mesh.CellSize)
  , Threads(threads)
  , File(mesh.Cells.Path)
  , First(first)
  , Next(first)
  , Last(last < 0 ? mesh.Cells.Tuples : last)
{
  if (first < 0 || first > this->Last || this->Last > mesh.Cells.Tuples)
  {
    throw std::out_of_range("cells beyond the mesh are asked for");
  }
}

bool CellReader::next(std::int64_t cells, std::vector<std::int64_t>& ids)
{
  this->First = this->Next;
  const std::int64_t count = std::min(std::max<std::int64_t>(cells, 1), this->Last - this->First);
  ids.resize(std::size_t(count * this->CellSize));
  this->read(this->First, count, ids.data());
  this->Next += count;
  return count > 0;
}

void CellReader::read(std::int64_t first, std::int64_t cells, std::int64_t* ids) const
{
  if (first < 0 || cells < 0 || cells > this->Cells.Tuples - first)
  {
    throw std::out_of_range("cells beyond the mesh are asked for");
  }
  const std::int64_t firstId = first * this->CellSize;
  const std::int64_t count = cells * this->CellSize;
  // Blocks per thread, enough to amortise the system calls.
  constexpr std::int64_t share = 64 * blockIds;
  parallelFor((count + share - 1) / share, this->Threads,
    [&](std::int64_t i)
    {
      poll();
      const std::int64_t from = i * share;
      const std::int64_t end = std::min(from + share, count);
      for (std::int64_t at = from; at < end; at += blockIds)
      {
        this->readBlock(firstId + at, std::min(blockIds, end - at), ids + at);
      }
    });
}

void CellReader::readBlock(std::int64_t firstId, std::int64_t count, std::int64_t* ids) const
{
  const std::size_t size = scalarSize(this->Cells.Type);
  const std::uint64_t offset = this->Cells.Offset + std::uint64_t(firstId) * size;
  if (this->Cells.Type == Scalar::Int32)
  {
    std::array<std::int32_t, blockIds> narrow;
    this->File.read(offset, narrow.data(), std::size_t(count) * size);
    std::copy(narrow.begin(), narrow.begin() + count, ids);
  }
  else
  {
    this->File.read(offset, ids, std::size_t(count) * size);
  }
  if (!areBelow(ids, std::size_t(count), this->Points))
  {
    this->reportBadId(firstId, count, ids);
  }
}

void CellReader::reportBadId(
  std::int64_t firstId, std::int64_t count, const std::int64_t* ids) const
{
  const std::int64_t* const bad = std::find_if(
    ids, ids + count, [this](std::int64_t id) { return id < 0 || id >= this->Points; });
  const std::int64_t cell = (firstId + (bad - ids)) / this->CellSize;
  throw IOError(this->File.path(),
    "gives cell " + std::to_string(cell) + " the vertex id " + std::to_string(*bad) +
      ", but the mesh has " + std::to_string(this->Points) +
      " points, counted from 0; correct the cells.");
}

} // namespace tipp
