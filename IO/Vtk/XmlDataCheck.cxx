// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/XmlDataCheck.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string>

namespace tipp
{
namespace
{

constexpr int notBase64 = -1;
constexpr int padding = -2;

int valueOf(char c)
{
  static const std::array<signed char, 256> values = []
  {
    std::array<signed char, 256> made{};
    made.fill(notBase64);
    int value = 0;
    for (const char* ranges : { "AZ", "az", "09", "++", "//" })
    {
      for (int c = ranges[0]; c <= ranges[1]; ++c)
      {
        made[std::size_t(c)] = static_cast<signed char>(value++);
      }
    }
    made[std::size_t('=')] = padding;
    return made;
  }();
  return values[static_cast<unsigned char>(c)];
}

bool isSpace(char c)
{
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

/// Parses the base64 text of one array part by part.
class Base64Text
{
public:
  explicit Base64Text(std::uint64_t header)
    : HeaderBytes(header)
    , HeaderEnd((header + 2) / 3 * 4)
  {
  }

  void add(std::string_view text)
  {
    for (const char c : text)
    {
      isSpace(c) ? void() : this->add(c);
    }
  }

  bool isBase64() const { return this->IsGood; }
  /// Whether there is one header, and nothing after the padding.
  bool isOneArray() const
  {
    return this->IsGood && !this->IsInterrupted && this->Count % 4 == 0 &&
      this->Header.size() == this->HeaderBytes;
  }
  const unsigned char* header() const { return this->Header.data(); }
  /// After the header.
  std::uint64_t byteCount() const
  {
    return this->Count / 4 * 3 - this->Padding - this->HeaderBytes;
  }

private:
  void add(char c)
  {
    const int value = valueOf(c);
    this->IsGood = this->IsGood && value != notBase64;
    if (value == padding)
    {
      // The header may be encoded separately.
      this->IsEnding = this->IsEnding || this->Count >= this->HeaderEnd;
      ++this->Padding;
    }
    else
    {
      this->IsInterrupted = this->IsInterrupted || this->IsEnding;
      this->takeHeader(unsigned(value));
    }
    ++this->Count;
  }

  void takeHeader(unsigned value)
  {
    if (this->Header.size() < this->HeaderBytes)
    {
      this->Bits = this->Bits << 6 | value;
      this->BitCount += 6;
    }
    if (this->BitCount >= 8)
    {
      this->BitCount -= 8;
      this->Header.push_back(static_cast<unsigned char>(this->Bits >> this->BitCount));
    }
  }

  const std::uint64_t HeaderBytes;
  const std::uint64_t HeaderEnd; ///< in characters
  bool IsGood = true;
  bool IsEnding = false;
  bool IsInterrupted = false;
  std::uint64_t Count = 0;
  std::uint64_t Padding = 0;
  unsigned Bits = 0;
  int BitCount = 0;
  std::vector<unsigned char> Header;
};

} // namespace

std::uint64_t XmlDataCheck::number(const unsigned char* bytes) const
{
  std::uint64_t value = 0;
  for (std::uint64_t i = 0; i < this->HeaderBytes; ++i)
  {
    value = value << 8 | bytes[this->IsBigEndian ? i : this->HeaderBytes - 1 - i];
  }
  return value;
}

template <typename Text>
bool XmlDataCheck::isWhole(const Text& text) const
{
  // Compressed blocks have checksums of their own.
  return this->IsCompressed ? text.isBase64()
                            : text.isOneArray() && this->number(text.header()) <= text.byteCount();
}

bool XmlDataCheck::isWholeText(std::string_view text) const
{
  Base64Text encoded(this->HeaderBytes);
  encoded.add(text);
  return this->isWhole(encoded);
}

bool XmlDataCheck::isWholeRaw(const InputFile& file, std::uint64_t begin, std::uint64_t end) const
{
  if (begin + this->HeaderBytes > end)
  {
    return false;
  }
  std::array<unsigned char, 8> header{};
  file.read(begin, header.data(), this->HeaderBytes);
  return this->IsCompressed || this->number(header.data()) <= end - begin - this->HeaderBytes;
}

bool XmlDataCheck::isWholeEncoded(
  const InputFile& file, std::uint64_t begin, std::uint64_t end) const
{
  Base64Text encoded(this->HeaderBytes);
  file.readBlocks(begin, end - begin,
    [&](const char* data, std::size_t bytes) {
      encoded.add({ data, bytes });
    });
  return this->isWhole(encoded);
}

bool XmlDataCheck::areWhole(const InputFile& file, std::uint64_t begin, bool isEncoded,
  std::vector<std::uint64_t> offsets) const
{
  constexpr std::uint64_t most = 4096; // from the end of the data to the end of the file
  std::string tail(std::min(most, file.size() - begin), '\0');
  file.read(file.size() - tail.size(), tail.data(), tail.size());
  const std::size_t close = tail.rfind("</AppendedData");
  std::uint64_t end = file.size() - (close == std::string::npos ? 0 : tail.size() - close);
  std::sort(offsets.begin(), offsets.end(), std::greater<>());
  offsets.erase(std::unique(offsets.begin(), offsets.end()), offsets.end());
  for (const std::uint64_t offset : offsets)
  {
    const bool isGood = offset < end - begin &&
      (isEncoded ? this->isWholeEncoded(file, begin + offset, end)
                 : this->isWholeRaw(file, begin + offset, end));
    if (!isGood)
    {
      return false;
    }
    end = begin + offset;
  }
  return true;
}

} // namespace tipp
