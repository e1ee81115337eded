// SPDX-License-Identifier: BSD-3-Clause
#include "Npy/NpyFile.h"

#include "Files/IOError.h"
#include "Npy/NpyHeader.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/stat.h>

namespace tipp
{
namespace
{

constexpr char magic[] = "\x93NUMPY";
constexpr std::size_t magicSize = 6;
// NumPy itself refuses headers above 10,000 bytes.
constexpr std::uint32_t headerLimit = 10000;

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

FileHandle openToRead(const std::string& path)
{
  FileHandle file(std::fopen(path.c_str(), "rb"));
  if (!file)
  {
    throw IOError(path, std::string("cannot be opened (") + std::strerror(errno) + ").");
  }
  return file;
}

std::string readHeaderText(std::FILE* file, const std::string& path)
{
  unsigned char start[12];
  const bool known = std::fread(start, 1, 10, file) == 10 &&
    std::memcmp(start, magic, magicSize) == 0 && start[6] >= 1 && start[6] <= 3;
  if (!known)
  {
    throw IOError(path, "is not an .npy file of version 1 to 3; save it with numpy.save.");
  }
  std::uint32_t length = start[8] | std::uint32_t(start[9]) << 8;
  if (start[6] > 1)
  {
    if (std::fread(start + 10, 1, 2, file) != 2)
    {
      throw IOError(path, "ends inside its .npy header; copy or save it again.");
    }
    length |= std::uint32_t(start[10]) << 16 | std::uint32_t(start[11]) << 24;
  }
  std::string text(length <= headerLimit ? length : 0, '\0');
  if (length > headerLimit || std::fread(text.data(), 1, length, file) != length)
  {
    throw IOError(path,
      "has an .npy header of " + std::to_string(length) +
        " bytes, more than the file or the format allows; copy or save it again.");
  }
  return text;
}

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
  std::FILE* file, const std::string& path, const NpyHeader& header, std::int64_t scalarSize)
{
  std::int64_t expected = 0;
  const bool overflow = __builtin_mul_overflow(header.Shape[0], header.Shape[1], &expected) ||
    __builtin_mul_overflow(expected, scalarSize, &expected);
  struct stat status = {};
  if (fstat(fileno(file), &status) != 0 || !S_ISREG(status.st_mode))
  {
    throw IOError(path, "is not an ordinary file; copy it to one.");
  }
  const std::int64_t present = std::int64_t(status.st_size) - std::int64_t(std::ftell(file));
  if (overflow || expected != present)
  {
    throw IOError(path,
      "holds " + std::to_string(present) + " bytes of data where its header's " +
        std::to_string(header.Shape[0]) + " x " + std::to_string(header.Shape[1]) +
        " numbers need " + (overflow ? "more than 2^63" : std::to_string(expected)) +
        "; copy or save it again.");
  }
}

} // namespace

NpyReader::NpyReader(const std::string& path)
  : Path(path)
  , File(openToRead(path))
{
  const std::optional<NpyHeader> header = parseNpyHeader(readHeaderText(this->File.get(), path));
  if (!header)
  {
    throw IOError(
      path, "has an .npy header that does not describe a plain array; save it with numpy.save.");
  }
  if (header->Shape.size() != 2)
  {
    throw IOError(path,
      "holds an array of " + std::to_string(header->Shape.size()) +
        " dimensions; save a table of rows and columns.");
  }
  if (header->FortranOrder)
  {
    throw IOError(path, "is in Fortran order; save numpy.ascontiguousarray of it.");
  }
  const ScalarType& scalar = findScalarType(header->Descr, path);
  checkFileSize(this->File.get(), path, *header, scalar.Size);
  this->Scalar = scalar.Type;
  this->Rows = header->Shape[0];
  this->Columns = header->Shape[1];
}

void NpyReader::read(void* to, std::size_t bytes)
{
  // An empty array may have no memory at all.
  if (bytes != 0 && std::fread(to, 1, bytes, this->File.get()) != bytes)
  {
    throw IOError(this->Path, "cannot be read to its end; check the disk and copy it again.");
  }
}

NpyWriter::NpyWriter(
  const std::string& path, const std::string& descr, std::int64_t rows, std::int64_t columns)
  : Path(path)
  , Pending(path)
  , File(std::fopen(this->Pending.temporaryPath().c_str(), "wb"))
{
  if (!this->File)
  {
    throw IOError(path, std::string("cannot be written (") + std::strerror(errno) + ").");
  }
  std::string text = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" +
    std::to_string(rows) + ", " + std::to_string(columns) + "), }";
  // The data start at a multiple of 64 bytes; the header ends with a newline.
  const std::size_t prefix = magicSize + 4;
  text.append(63 - (prefix + text.size()) % 64, ' ');
  text += '\n';
  const unsigned char start[4] = { 1, 0, static_cast<unsigned char>(text.size() & 0xff),
    static_cast<unsigned char>(text.size() >> 8) };
  this->write(magic, magicSize);
  this->write(start, sizeof(start));
  this->write(text.data(), text.size());
}

void NpyWriter::write(const void* from, std::size_t bytes)
{
  if (bytes != 0 && std::fwrite(from, 1, bytes, this->File.get()) != bytes)
  {
    throw IOError(this->Path, std::string("cannot be written (") + std::strerror(errno) + ").");
  }
}

void NpyWriter::close()
{
  if (std::fclose(this->File.release()) != 0)
  {
    throw IOError(this->Path, std::string("cannot be written (") + std::strerror(errno) + ").");
  }
  this->Pending.commit();
}

} // namespace tipp
