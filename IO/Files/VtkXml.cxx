// SPDX-License-Identifier: BSD-3-Clause
#include "Files/VtkXml.h"

#include "Files/TextFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <functional>

namespace tipp
{
namespace
{

void appendUtf8(std::uint32_t code, std::string& to)
{
  if (code < 0x80)
  {
    to += char(code);
    return;
  }
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr std::array<std::uint32_t, 4> first = { 0, 0xC0, 0xE0, 0xF0 };
  to += char(first[std::size_t(more)] | code >> (6 * more));
  for (int shift = 6 * (more - 1); shift >= 0; shift -= 6)
  {
    to += char(0x80 | (code >> shift & 0x3F));
  }
}

/// Appends the character that a reference at the text's start denotes, and returns the reference's
/// length; 0 if there is none. Supports character numbers and XML's five predefined names.
std::size_t takeReference(std::string_view text, std::string& to)
{
  constexpr std::array<std::pair<std::string_view, char>, 5> entities = { {
    { "&amp;", '&' },
    { "&lt;", '<' },
    { "&gt;", '>' },
    { "&quot;", '"' },
    { "&apos;", '\'' },
  } };
  for (const auto& [entity, value] : entities)
  {
    if (text.substr(0, entity.size()) == entity)
    {
      to += value;
      return entity.size();
    }
  }
  const bool hex = text.substr(0, 3) == "&#x";
  const std::size_t end = text.find(';');
  if (text.substr(0, 2) != "&#" || end == std::string_view::npos)
  {
    return 0;
  }
  std::uint32_t code = 0;
  const auto [stop, error] =
    std::from_chars(text.data() + (hex ? 3 : 2), text.data() + end, code, hex ? 16 : 10);
  if (error != std::errc() || stop != text.data() + end || code == 0 || code > 0x10FFFF)
  {
    return 0;
  }
  appendUtf8(code, to);
  return end + 1;
}

/// Replaces references; anything else is copied.
std::string decode(std::string_view text)
{
  std::string decoded;
  while (!text.empty())
  {
    std::size_t taken = text.front() == '&' ? takeReference(text, decoded) : 0;
    if (taken == 0)
    {
      decoded += text.front();
      taken = 1;
    }
    text.remove_prefix(taken);
  }
  return decoded;
}

} // namespace

const std::string* XmlScanner::Tag::find(std::string_view name) const
{
  for (const auto& [key, value] : this->Attributes)
  {
    if (key == name)
    {
      return &value;
    }
  }
  return nullptr;
}

bool XmlScanner::fail()
{
  this->Failed = true;
  return false;
}

bool XmlScanner::skipPast(std::string_view end)
{
  const std::size_t found = this->Text.find(end, this->At);
  if (found == std::string_view::npos)
  {
    return this->fail();
  }
  this->At = found + end.size();
  return true;
}

void XmlScanner::skipBlanks()
{
  while (this->At < this->Text.size() &&
    std::isspace(static_cast<unsigned char>(this->Text[this->At])) != 0)
  {
    ++this->At;
  }
}

std::string XmlScanner::takeName()
{
  const std::size_t end =
    std::min(this->Text.find_first_of(" \t\r\n=/><\"'", this->At), this->Text.size());
  std::string name(this->Text.substr(this->At, end - this->At));
  this->At = end;
  return name;
}

bool XmlScanner::takeAttribute(Tag& tag)
{
  std::string name = this->takeName();
  this->skipBlanks();
  if (name.empty() || this->Text.substr(this->At, 1) != "=")
  {
    return this->fail();
  }
  ++this->At;
  this->skipBlanks();
  const std::string_view quote = this->Text.substr(this->At, 1);
  const std::size_t end =
    quote == "\"" || quote == "'" ? this->Text.find(quote, this->At + 1) : std::string_view::npos;
  if (end == std::string_view::npos || tag.find(name))
  {
    return this->fail();
  }
  tag.Attributes.emplace_back(
    std::move(name), decode(this->Text.substr(this->At + 1, end - this->At - 1)));
  this->At = end + 1;
  return true;
}

bool XmlScanner::next(Tag& tag)
{
  if (this->Failed)
  {
    return false;
  }
  for (;;)
  {
    this->At = std::min(this->Text.find('<', this->At), this->Text.size());
    const std::string_view rest = this->Text.substr(this->At);
    const bool comment = rest.substr(0, 4) == "<!--";
    if (!comment && rest.substr(0, 2) != "<?")
    {
      break;
    }
    if (!this->skipPast(comment ? "-->" : "?>"))
    {
      return false;
    }
  }
  if (this->At == this->Text.size())
  {
    return false;
  }
  ++this->At;
  tag = Tag();
  if (this->Text.substr(this->At, 1) == "/")
  {
    ++this->At;
    tag.What = Tag::Close;
  }
  tag.Name = this->takeName();
  if (tag.Name.empty())
  {
    return this->fail();
  }
  for (this->skipBlanks(); this->At < this->Text.size(); this->skipBlanks())
  {
    if (this->Text[this->At] == '>')
    {
      ++this->At;
      return true;
    }
    if (tag.What == Tag::Open && this->Text.substr(this->At, 2) == "/>")
    {
      tag.What = Tag::Empty;
      this->At += 2;
      return true;
    }
    if (tag.What == Tag::Close || !this->takeAttribute(tag))
    {
      return this->fail();
    }
  }
  return this->fail();
}

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
      const auto last = static_cast<unsigned char>(ranges[1]);
      for (auto c = static_cast<unsigned char>(ranges[0]); c <= last; ++c)
      {
        made[c] = static_cast<signed char>(value++);
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
      if (!isSpace(c))
      {
        this->add(c);
      }
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
  const std::uint64_t HeaderEnd; ///< length of the encoded header, in characters
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
  constexpr std::uint64_t most =
    4096; // largest distance from the end of the data to the end of the file
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

XmlHead readXmlHead(const InputFile& file, std::uint64_t most)
{
  constexpr std::uint64_t step = 1 << 16;
  XmlHead head;
  std::string& text = head.Text;
  std::size_t begin = std::string::npos;
  for (std::uint64_t at = 0; at < std::min(file.size(), most) && begin == std::string::npos;)
  {
    const auto bytes = std::size_t(std::min(file.size() - at, std::max(step, at)));
    const std::size_t searched = text.size() - std::min<std::size_t>(text.size(), 64);
    text.resize(text.size() + bytes);
    file.read(at, text.data() + at, bytes);
    at += bytes;
    begin = text.find("<AppendedData", searched);
  }
  if (begin == std::string::npos)
  {
    return head;
  }
  text.resize(begin);
  constexpr std::uint64_t longestTag = 4096;
  std::string tagText(std::size_t(std::min(longestTag, file.size() - begin)), '\0');
  file.read(begin, tagText.data(), tagText.size());
  XmlScanner scanner(tagText);
  XmlScanner::Tag tag;
  const std::size_t data =
    scanner.next(tag) ? tagText.find('_', scanner.position()) : std::string::npos;
  head.DataStart = data == std::string::npos ? 0 : begin + data + 1;
  const std::string* const encoding = tag.find("encoding");
  head.Encoding = encoding ? *encoding : "base64";
  return head;
}

std::string escapedXml(const std::string& text)
{
  std::string out;
  for (const char c : utf8Of(text))
  {
    const auto code = static_cast<unsigned char>(c);
    if (c == '&' || c == '<' || c == '>' || c == '"' || c == '\t' || c == '\n' || c == '\r')
    {
      out += "&#" + std::to_string(int(code)) + ";";
    }
    else if (code < 0x20)
    {
      out += '?'; // XML has no other control characters
    }
    else
    {
      out += c;
    }
  }
  return out;
}

} // namespace tipp
