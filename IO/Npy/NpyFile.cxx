// SPDX-License-Identifier: BSD-3-Clause
#include "Npy/NpyFile.h"

#include "Files/IOError.h"
#include "Files/RawArray.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

namespace tipp
{
namespace
{

constexpr char magic[] = "\x93NUMPY";
constexpr std::size_t magicSize = 6;
// NumPy itself rejects headers above 10,000 bytes.
constexpr std::uint64_t headerLimit = 10000;

/// The dictionary at the start of a file.
struct NpyHeader
{
  std::string Descr;               ///< NumPy's name of the scalar type, such as "<f8"
  bool FortranOrder = false;       ///< whether the array is stored column by column
  std::vector<std::int64_t> Shape; ///< extent along each axis
};

class Scanner
{
public:
  explicit Scanner(std::string_view text)
    : Text(text)
  {
  }

  bool take(std::string_view token)
  {
    this->skipSpace();
    if (this->Text.substr(0, token.size()) != token)
    {
      return false;
    }
    this->Text.remove_prefix(token.size());
    return true;
  }

  bool takeString(std::string& value)
  {
    const char* const quote = this->take("'") ? "'" : (this->take("\"") ? "\"" : nullptr);
    const std::size_t end = quote ? this->Text.find(quote) : std::string_view::npos;
    if (end == std::string_view::npos)
    {
      return false;
    }
    value = this->Text.substr(0, end);
    this->Text.remove_prefix(end + 1);
    return true;
  }

  bool takeBool(bool& value)
  {
    value = this->take("True");
    return value || this->take("False");
  }

  bool takeExtent(std::int64_t& value)
  {
    this->skipSpace();
    const char* const end = this->Text.data() + this->Text.size();
    const auto [stop, error] = std::from_chars(this->Text.data(), end, value);
    if (error != std::errc() || value < 0)
    {
      return false;
    }
    this->Text.remove_prefix(std::size_t(stop - this->Text.data()));
    return true;
  }

  bool takeShape(std::vector<std::int64_t>& shape)
  {
    if (!this->take("("))
    {
      return false;
    }
    while (!this->take(")"))
    {
      shape.emplace_back();
      if (!this->takeExtent(shape.back()))
      {
        return false;
      }
      if (!this->take(","))
      {
        return this->take(")");
      }
    }
    return true;
  }

  bool atEnd()
  {
    this->skipSpace();
    return this->Text.empty();
  }

private:
  void skipSpace()
  {
    const std::size_t start = this->Text.find_first_not_of(" \t\r\n");
    this->Text.remove_prefix(start == std::string_view::npos ? this->Text.size() : start);
  }

  std::string_view Text;
};

/// Parses the dictionary; nullopt unless it has exactly the three keys with plain values, and no
/// negative extent.
std::optional<NpyHeader> parseNpyHeader(std::string_view text)
{
  Scanner scanner(text);
  NpyHeader header;
  bool descr = false;
  bool order = false;
  bool shape = false;
  if (!scanner.take("{"))
  {
    return std::nullopt;
  }
  while (!scanner.take("}"))
  {
    std::string key;
    if (!scanner.takeString(key) || !scanner.take(":"))
    {
      return std::nullopt;
    }
    const bool good = (key == "descr" && !descr && (descr = scanner.takeString(header.Descr))) ||
      (key == "fortran_order" && !order && (order = scanner.takeBool(header.FortranOrder))) ||
      (key == "shape" && !shape && (shape = scanner.takeShape(header.Shape)));
    if (!good || (!scanner.take(",") && !scanner.take("}")))
    {
      return std::nullopt;
    }
    if (descr && order && shape)
    {
      scanner.take("}");
      return scanner.atEnd() ? std::make_optional(header) : std::nullopt;
    }
  }
  return std::nullopt;
}

/// Reads the dictionary of a file of version 1 to 3 and the offset of its data in bytes.
NpyHeader readNpyHeader(const InputFile& file, std::uint64_t& dataOffset)
{
  unsigned char start[12] = {};
  const std::uint64_t size = file.size();
  file.read(0, start, std::size_t(std::min<std::uint64_t>(size, sizeof(start))));
  const int version = start[6];
  if (size < 10 || std::memcmp(start, magic, magicSize) != 0 || version < 1 || version > 3)
  {
    throw IOError(file.path(), "is not an .npy file of version 1 to 3; save it with numpy.save.");
  }
  std::uint64_t length = start[8] | std::uint64_t(start[9]) << 8;
  dataOffset = 10;
  if (version > 1)
  {
    length |= std::uint64_t(start[10]) << 16 | std::uint64_t(start[11]) << 24;
    dataOffset = 12;
  }
  if (length > headerLimit || dataOffset + length > size)
  {
    throw IOError(file.path(),
      "has an .npy header of " + std::to_string(length) +
        " bytes, more than the file or the format allows; copy or save it again.");
  }
  std::string text(length, '\0');
  file.read(dataOffset, text.data(), text.size());
  dataOffset += length;
  const std::optional<NpyHeader> header = parseNpyHeader(text);
  if (!header)
  {
    throw IOError(file.path(),
      "has an .npy header that does not describe a plain array; save it with numpy.save.");
  }
  return *header;
}

Scalar scalarOf(const std::string& descr, const std::string& path)
{
  const std::optional<Scalar> type = scalarFromDescr(descr == "|b1" ? "|u1" : descr);
  return type ? *type
              : throw IOError(path,
                  "holds elements of type '" + descr +
                    "'; save it as little-endian integers, float32 or float64.");
}

} // namespace

std::string NpyArray::shapeText() const
{
  std::string text;
  for (const std::int64_t extent : this->Shape)
  {
    text += (text.empty() ? "" : " x ") + std::to_string(extent);
  }
  return text.empty() ? "a single number" : text;
}

NpyArray openNpyArray(const InputFile& file)
{
  NpyArray array;
  array.Path = file.path();
  const NpyHeader header = readNpyHeader(file, array.Offset);
  array.Shape = header.Shape;
  array.Type = scalarOf(header.Descr, array.Path);
  if (header.FortranOrder && header.Shape.size() > 1)
  {
    throw IOError(array.Path, "is in Fortran order; save numpy.ascontiguousarray of it.");
  }
  std::int64_t expected = std::int64_t(scalarSize(array.Type));
  bool overflow = false;
  for (const std::int64_t extent : array.Shape)
  {
    overflow = __builtin_mul_overflow(expected, extent, &expected) || overflow;
  }
  const std::uint64_t present = file.size() - array.Offset;
  if (overflow || std::uint64_t(expected) != present)
  {
    throw IOError(array.Path,
      "holds " + std::to_string(present) + " bytes of data where its header's " +
        array.shapeText() + " elements need " +
        (overflow ? "more than 2^63" : std::to_string(expected)) + "; copy or save it again.");
  }
  return array;
}

std::string npyFileStart(const std::string& descr, const std::vector<std::int64_t>& shape)
{
  std::string text = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (";
  for (std::size_t axis = 0; axis < shape.size(); ++axis)
  {
    text += (axis > 0 ? ", " : "") + std::to_string(shape[axis]);
  }
  text += shape.size() == 1 ? ",), }" : "), }";
  // The header ends with a newline.
  const std::size_t prefix = magicSize + 4;
  text.append(63 - (prefix + text.size()) % 64, ' ');
  text += '\n';
  const char counts[4] = { 1, 0, char(text.size() & 0xff), char(text.size() >> 8) };
  return std::string(magic, magicSize) + std::string(counts, sizeof(counts)) + text;
}

NpyReader::NpyReader(const std::string& path)
  : File(path)
  , Array(openNpyArray(this->File))
  , Offset(this->Array.Offset)
{
  const std::size_t dimensions = this->Array.Shape.size();
  if (dimensions != 2)
  {
    throw IOError(path,
      "holds an array of " + std::to_string(dimensions) +
        " dimensions; save a table of rows and columns.");
  }
  if (scalarSize(this->type()) < 4)
  {
    throw IOError(path,
      std::string("holds elements of type ") + scalarName(this->type()) +
        "; save it as float64, float32 or integers of 32 or 64 bits.");
  }
}

void NpyReader::seekRow(std::int64_t row)
{
  this->Offset = this->Array.Offset +
    std::uint64_t(row) * std::uint64_t(this->columns()) * scalarSize(this->type());
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

void writePoints(
  const std::string& path, const std::vector<double>& xy, const std::optional<PathState>& before)
{
  NpyWriter writer(path, "<f8", { std::int64_t(xy.size() / 2), 2 }, before);
  writer.write(xy.data(), xy.size() * sizeof(double));
  writer.close();
}

} // namespace tipp
