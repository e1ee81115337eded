// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TextFile.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace tipp
{
namespace
{

bool isBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimBlanks(std::string_view text)
{
  while (!text.empty() && isBlank(text.front()))
  {
    text.remove_prefix(1);
  }
  while (!text.empty() && isBlank(text.back()))
  {
    text.remove_suffix(1);
  }
  return text;
}

void splitAtBlanks(std::string_view line, std::vector<std::string_view>& fields)
{
  std::size_t at = 0;
  while (at < line.size())
  {
    while (at < line.size() && isBlank(line[at]))
    {
      ++at;
    }
    const std::size_t start = at;
    while (at < line.size() && !isBlank(line[at]))
    {
      ++at;
    }
    if (at > start)
    {
      fields.push_back(line.substr(start, at - start));
    }
  }
}

} // namespace

std::string readTextFile(const std::string& path)
{
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
    std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file)
  {
    throw IOError(path, std::string("cannot be opened (") + std::strerror(errno) + ").");
  }
  std::string text;
  std::size_t size = 0;
  std::size_t got = 0;
  do
  {
    text.resize(std::max<std::size_t>(std::size_t(1) << 20, 2 * size));
    got = std::fread(&text[size], 1, text.size() - size, file.get());
    size += got;
  } while (size == text.size());
  if (std::ferror(file.get()))
  {
    throw IOError(path, std::string("cannot be read (") + std::strerror(errno) + ").");
  }
  text.resize(size);
  if (std::memchr(text.data(), '\0', std::min<std::size_t>(size, 4096)))
  {
    throw IOError(path, "is not a text file; give its extension as what it is.");
  }
  return text;
}

LineReader::LineReader(std::string_view text)
  : Rest(text)
{
  constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
  if (this->Rest.substr(0, byteOrderMark.size()) == byteOrderMark)
  {
    this->Rest.remove_prefix(byteOrderMark.size());
  }
}

bool LineReader::next(std::string_view& line)
{
  if (this->Rest.empty())
  {
    return false;
  }
  const std::size_t end = std::min(this->Rest.find('\n'), this->Rest.size());
  line = this->Rest.substr(0, end);
  if (!line.empty() && line.back() == '\r')
  {
    line.remove_suffix(1);
  }
  this->Rest.remove_prefix(std::min(end + 1, this->Rest.size()));
  ++this->Number;
  return true;
}

std::int64_t LineReader::remainingLines() const
{
  return 1 + std::count(this->Rest.begin(), this->Rest.end(), '\n');
}

std::string_view trimField(std::string_view field)
{
  field = trimBlanks(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
  {
    field = trimBlanks(field.substr(1, field.size() - 2));
  }
  return field;
}

bool parseNumber(std::string_view field, double& value)
{
  field = trimField(field);
  if (field.size() > 1 && field[0] == '+' && field[1] != '-')
  {
    field.remove_prefix(1);
  }
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error == std::errc::result_out_of_range && stop == end)
  {
    value = std::strtod(std::string(field).c_str(), nullptr); // rounds to 0 or infinity
    return true;
  }
  return error == std::errc() && stop == end;
}

bool parseInteger(std::string_view field, std::int64_t& value)
{
  field = trimField(field);
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  return error == std::errc() && stop == end;
}

void splitFields(std::string_view line, char delimiter, std::vector<std::string_view>& fields)
{
  fields.clear();
  if (delimiter == ' ')
  {
    splitAtBlanks(line, fields);
    return;
  }
  std::size_t start = 0;
  while (true)
  {
    std::size_t from = start;
    while (from < line.size() && isBlank(line[from]) && line[from] != delimiter)
    {
      ++from;
    }
    if (from < line.size() && line[from] == '"')
    {
      from = std::min(line.find('"', from + 1), line.size());
    }
    const std::size_t end = std::min(line.find(delimiter, from), line.size());
    fields.push_back(line.substr(start, end - start));
    if (end == line.size())
    {
      return;
    }
    start = end + 1;
  }
}

} // namespace tipp
