// SPDX-License-Identifier: BSD-3-Clause
#include "Npy/NpyHeader.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"

#include <algorithm>
#include <charconv>
#include <cstring>

namespace tipp
{
namespace
{

constexpr char magic[] = "\x93NUMPY";
constexpr std::size_t magicSize = 6;
// NumPy itself rejects headers above 10,000 bytes.
constexpr std::uint64_t headerLimit = 10000;

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

} // namespace

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

} // namespace tipp
