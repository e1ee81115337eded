// SPDX-License-Identifier: BSD-3-Clause
#include "Npy/NpyFile.h"

#include "Files/IOError.h"
#include "Parallel/Poll.h"

#include <array>
#include <cstring>

namespace tipp
{
namespace
{

struct ScalarType
{
  const char* Descr;
  NpyReader::Type Type;
  std::int64_t Size;
};

constexpr std::array<ScalarType, 6> scalarTypes = { {
  { "<f4", NpyReader::Type::Float32, 4 },
  { "<f8", NpyReader::Type::Float64, 8 },
  { "<i4", NpyReader::Type::Int32, 4 },
  { "<i8", NpyReader::Type::Int64, 8 },
  { "<u4", NpyReader::Type::UInt32, 4 },
  { "<u8", NpyReader::Type::UInt64, 8 },
} };

const ScalarType& findScalarType(const std::string& descr, const std::string& path)
{
  for (const ScalarType& candidate : scalarTypes)
  {
    if (descr == candidate.Descr)
    {
      return candidate;
    }
  }
  throw IOError(path,
    "holds numbers of type '" + descr +
      "'; save it as little-endian float64, float32 or integers of 32 or 64 bits.");
}

void checkFileSize(
  const InputFile& file, std::uint64_t offset, const NpyHeader& header, std::int64_t scalarSize)
{
  std::int64_t expected = 0;
  const bool overflow = __builtin_mul_overflow(header.Shape[0], header.Shape[1], &expected) ||
    __builtin_mul_overflow(expected, scalarSize, &expected);
  const std::int64_t present = std::int64_t(file.size() - offset);
  if (overflow || expected != present)
  {
    throw IOError(file.path(),
      "holds " + std::to_string(present) + " bytes of data where its header's " +
        std::to_string(header.Shape[0]) + " x " + std::to_string(header.Shape[1]) +
        " numbers need " + (overflow ? "more than 2^63" : std::to_string(expected)) +
        "; copy or save it again.");
  }
}

} // namespace

NpyReader::NpyReader(const std::string& path)
  : File(path)
{
  const NpyHeader header = readNpyHeader(this->File, this->Offset);
  if (header.Shape.size() != 2)
  {
    throw IOError(path,
      "holds an array of " + std::to_string(header.Shape.size()) +
        " dimensions; save a table of rows and columns.");
  }
  if (header.FortranOrder)
  {
    throw IOError(path, "is in Fortran order; save numpy.ascontiguousarray of it.");
  }
  const ScalarType& scalar = findScalarType(header.Descr, path);
  checkFileSize(this->File, this->Offset, header, scalar.Size);
  this->Scalar = scalar.Type;
  this->Rows = header.Shape[0];
  this->Columns = header.Shape[1];
}

void NpyReader::skipRows(std::int64_t rows)
{
  const bool isWide =
    this->Scalar == Type::Float64 || this->Scalar == Type::Int64 || this->Scalar == Type::UInt64;
  this->Offset += std::uint64_t(rows) * std::uint64_t(this->Columns) * (isWide ? 8 : 4);
}

void NpyReader::read(void* to, std::size_t bytes)
{
  this->File.read(this->Offset, to, bytes);
  this->Offset += bytes;
}

NpyWriter::NpyWriter(const std::string& path, const std::string& descr,
  const std::vector<std::int64_t>& shape, const std::optional<PathState>& before)
  : Pending(path, before)
{
  const std::string start = npyFileStart(descr, shape);
  this->write(start.data(), start.size());
}

void NpyWriter::write(const void* from, std::size_t bytes)
{
  constexpr std::size_t most = std::size_t(1) << 24;
  const char* at = static_cast<const char*>(from);
  for (std::size_t left = bytes; left > 0;)
  {
    poll();
    const std::size_t part = std::min(left, most);
    this->Pending.file().write(this->End, at, part);
    this->End += part;
    at += part;
    left -= part;
  }
}

void NpyWriter::close()
{
  this->Pending.commit();
}

} // namespace tipp
