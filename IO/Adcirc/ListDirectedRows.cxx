// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/ListDirectedRows.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace tipp
{

bool parseFortranNumber(std::string_view field, double& value)
{
  if (parseNumber(field, value))
  {
    return true;
  }
  // The sign of the number itself is not that of an exponent.
  const std::size_t at = field.find_first_of("dDqQ+-", 1);
  if (at == std::string_view::npos || field.substr(0, at).find_first_not_of("+-.0123456789") < at)
  {
    return false;
  }
  const bool hasLetter = std::isalpha(static_cast<unsigned char>(field[at])) != 0;
  const std::string_view exponent = field.substr(at + (hasLetter ? 1 : 0));
  return parseNumber(std::string(field.substr(0, at)) + "e" + std::string(exponent), value);
}

ListDirectedRows::ListDirectedRows(const std::string& path, std::string kind)
  : Path(path)
  , Kind(std::move(kind))
  , Text(readTextFile(path))
  , Lines(this->Text)
  , Total(1 + std::count(this->Text.begin(), this->Text.end(), '\n'))
{
}

std::string_view ListDirectedRows::title()
{
  std::string_view line;
  this->Lines.next(line);
  return line;
}

void ListDirectedRows::next(std::size_t fields, const char* what)
{
  const auto failShort = [&]
  {
    this->fail(
      std::string("has too few numbers for ") + what + "; check that it is " + this->Kind + ".");
  };
  this->Row.clear();
  this->ExpectsValue = true;
  this->IsEnded = false;
  std::size_t before = 0; // values on earlier lines
  while (this->Row.size() < fields && !this->IsEnded)
  {
    before = this->Row.size();
    std::string_view line;
    if (!this->Lines.next(line))
    {
      this->IsBeyondEnd = true;
      if (before > 0)
      {
        failShort();
      }
      this->RowLine = this->Lines.lineNumber();
      this->fail(std::string("the file ends before ") + what + "; copy it again.");
    }
    this->RowLine = before == 0 ? this->Lines.lineNumber() : this->RowLine;
    this->addLine(line);
  }
  // Programs that break a row write nothing else on its last line. More values there are the next
  // row's, after a row that lacks some.
  if (this->Row.size() < fields || (before > 0 && this->Row.size() > fields))
  {
    failShort();
  }
}

bool ListDirectedRows::endsInLine() const
{
  const bool hasEnd = !this->Text.empty() && this->Text.back() == '\n';
  return this->isAtEnd() && !hasEnd;
}

bool ListDirectedRows::isCutOff() const
{
  return this->endsInLine() || (this->isAtEnd() && this->IsBeyondEnd);
}

void ListDirectedRows::addLine(std::string_view line)
{
  constexpr std::string_view separators = " \t\r,/";
  for (std::size_t at = 0; at < line.size() && !this->IsEnded;)
  {
    const char c = line[at];
    if (c == '/')
    {
      this->IsEnded = true;
    }
    else if (c == ',')
    {
      if (this->ExpectsValue)
      {
        this->addValues(1, {});
      }
      this->ExpectsValue = true;
    }
    else if (separators.find(c) == std::string_view::npos)
    {
      const bool isQuoted = c == '"' || c == '\'';
      const std::size_t end =
        std::min(isQuoted ? line.find(c, at + 1) : line.find_first_of(separators, at), line.size());
      const std::size_t length = end - at + (isQuoted && end < line.size() ? 1 : 0);
      this->addValue(line.substr(at, length));
      at += length;
      continue;
    }
    ++at;
  }
}

void ListDirectedRows::addValue(std::string_view text)
{
  this->ExpectsValue = false;
  const std::size_t star = text.find('*');
  const auto count = wholeNumber<std::uint32_t>(text.substr(0, star));
  star != std::string_view::npos&& count&&* count > 0
    ? this->addValues(*count, text.substr(star + 1))
    : this->addValues(1, text);
}

void ListDirectedRows::addValues(std::size_t count, std::string_view text)
{
  constexpr std::size_t most = 64; // more than any row needs
  const std::size_t room = most - std::min(most, this->Row.size());
  this->Row.insert(this->Row.end(), std::min(count, room), text);
}

bool ListDirectedRows::isNumber(std::size_t field) const
{
  double value = 0;
  return parseFortranNumber(this->Row[field], value);
}

double ListDirectedRows::number(std::size_t field) const
{
  double value = 0;
  if (!parseFortranNumber(this->Row[field], value))
  {
    this->failToRead(field, "a number");
  }
  return value;
}

std::int64_t ListDirectedRows::integer(std::size_t field) const
{
  std::int64_t value = 0;
  if (!parseWhole(this->Row[field], value))
  {
    this->failToRead(field, "an integer");
  }
  return value;
}

void ListDirectedRows::failToRead(std::size_t field, const char* kind) const
{
  const std::string text(this->Row[field]);
  this->fail(text.empty() ? std::string("gives no value where ") + kind + " is needed; add it."
                          : "'" + text + "' is not " + kind + "; correct the line.");
}

void ListDirectedRows::fail(const std::string& problem) const
{
  throw IOError(this->Path, this->RowLine, problem);
}

} // namespace tipp
