// SPDX-License-Identifier: BSD-3-Clause
#include "Points/TableRows.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace tipp
{
namespace
{

/// Whether a field of digits only differs from the double that it was parsed as.
bool isRoundedInteger(std::string_view field, double value)
{
  constexpr double exact = 0x1p53;
  if (!(std::fabs(value) >= exact))
  {
    return false;
  }
  field = trimField(field);
  if (field.front() == '+' || field.front() == '-')
  {
    field.remove_prefix(1);
  }
  field.remove_prefix(std::min(field.find_first_not_of('0'), field.size()));
  if (field.find_first_not_of("0123456789") != std::string_view::npos)
  {
    return false;
  }
  char digits[400];
  std::snprintf(digits, sizeof(digits), "%.0f", std::fabs(value));
  return field != digits;
}

std::string_view trimEnd(std::string_view line)
{
  while (!line.empty() && line.back() == ' ')
  {
    line.remove_suffix(1);
  }
  return line;
}

} // namespace

TableRows::TableRows(const std::string& path, const PointOptions& options)
  : Path(path)
  , Options(options)
  , Lines(path)
{
  this->readStart();
  this->chooseColumns();
}

std::optional<PointNumberTest> TableRows::numberTest() const
{
  const bool isOpen = !this->isNamed() && !this->Options.AsIs && this->Options.X.empty();
  return isOpen ? std::make_optional<PointNumberTest>(this->Width) : std::nullopt;
}

void TableRows::failForNumbers() const
{
  throw IOError(this->Path,
    "has no names of columns, and the first column looks like numbers of points; choose the "
    "columns with --x, --y and --z, counted from 0, such as --x 1 --y 2 --z 3 where the easting "
    "comes first, or --x 2 --y 1 --z 3 where the northing does.");
}

void TableRows::requireClearCommas() const
{
  const std::string unclear = this->Parser.unclear();
  if (!unclear.empty())
  {
    throw IOError(this->Path,
      "has numbers such as '" + shown(unclear) +
        "', whose comma may be a decimal comma or separate thousands; write decimal points.");
  }
}

void TableRows::fail(const std::string& problem) const
{
  throw IOError(this->Path, this->Lines.lineNumber(), problem);
}

std::string TableRows::shown(std::string_view field)
{
  constexpr std::size_t most = 40;
  return utf8Of(trimField(field).substr(0, most));
}

bool TableRows::lacksCoordinate()
{
  const auto isMissing = [this](std::size_t column)
  {
    double value = 0;
    return this->parse(column, value) != FieldKind::Number &&
      lowerCase(trimField(this->Row[column])) != "nan";
  };
  return isMissing(this->Choice.X) || isMissing(this->Choice.Y);
}

bool TableRows::areObvious() const
{
  return this->isNamed() && this->Names[this->Choice.X] == "x" &&
    this->Names[this->Choice.Y] == "y" &&
    (this->Choice.Z ? this->Names[*this->Choice.Z] == "z" : this->Width == 2);
}

std::string TableRows::describe() const
{
  std::string text =
    "x from " + this->nameOf(this->Choice.X) + ", y from " + this->nameOf(this->Choice.Y);
  return this->Choice.Z ? text + ", z from " + this->nameOf(*this->Choice.Z) +
      (this->Choice.IsDepth ? " as it stands, though a depth counts downwards" : "")
                        : text + ", no heights";
}

/// The last field may have a comment behind it.
FieldKind TableRows::parseLast(double& value)
{
  return this->Parser.parse(withoutTrailingComment(this->Row.back()), value);
}

std::string TableRows::nameOf(std::size_t column) const
{
  const std::string name = this->isNamed() ? this->Names[column] : "";
  return name.empty() ? "column " + std::to_string(column) : "'" + shownText(name) + "'";
}

void TableRows::requireCount() const
{
  if (this->Count && *this->Count != this->Rows)
  {
    throw IOError(this->Path,
      "announces " + std::to_string(*this->Count) + " points in its first line and holds " +
        std::to_string(this->Rows) + "; copy it again or correct the line.");
  }
}

bool TableRows::nextLine()
{
  while (this->Lines.next(this->Line))
  {
    const std::size_t start = this->Line.find_first_not_of(" \t");
    if (start == std::string_view::npos)
    {
      continue;
    }
    const char first = this->Line[start];
    const bool mayBeComment = first < '+' || first == '/' || first == ';' || first == '>';
    if (!mayBeComment || !isComment(this->Line))
    {
      return true;
    }
    if (this->Rows == 0 && this->Header)
    {
      this->Header->addComment(this->Lines.lineNumber(), this->Line);
    }
  }
  return false;
}

void TableRows::split(std::string_view line)
{
  // Files with blanks between columns may have one at the end of a line, too.
  if (!splitFields(this->Delimiter == ' ' ? line : trimEnd(line), this->Delimiter, this->Row))
  {
    this->fail("has a quote that does not end on the line; remove it, or the line break.");
  }
}

bool TableRows::fits()
{
  return this->FirstFields < this->Width ? this->addTexts()
    : this->FirstFields > this->Width    ? this->dropEmptyFields()
                                         : this->Row.size() == this->Width || this->joinText();
}

void TableRows::fitRow()
{
  const std::size_t fields = this->Row.size();
  const std::string_view bare = withoutTrailingComment(this->Line);
  if (bare.size() < this->Line.size())
  {
    this->split(bare);
  }
  if (this->fits())
  {
    return;
  }
  const std::string expected = fields == this->Width
    ? "the first row has " + std::to_string(this->FirstFields)
    : (this->isNamed() ? "line " + std::to_string(this->Header->line()) + " names "
                       : "the first point has ") +
      std::to_string(this->Width);
  this->fail("has " + std::to_string(fields) + " columns where " + expected +
    "; correct or remove the line.");
}

bool TableRows::dropEmptyFields()
{
  if (this->Row.size() != this->FirstFields ||
    !std::all_of(this->Row.begin() + std::ptrdiff_t(this->Width), this->Row.end(), isEmptyField))
  {
    return false;
  }
  this->Row.resize(this->Width);
  return true;
}

bool TableRows::isText(std::string_view field)
{
  double value = 0;
  return this->Parser.parse(field, value) == FieldKind::Text;
}

bool TableRows::isCoordinate(std::size_t column) const
{
  return column == this->Choice.X || column == this->Choice.Y || column == this->Choice.Z;
}

bool TableRows::joinText()
{
  const std::size_t last = this->Width - 1;
  if (!this->isNamed() || this->Row.size() <= this->Width || isEmptyField(this->Row.back()) ||
    this->isCoordinate(last) || !isTextColumn(this->Names[last]) ||
    !this->isText(this->Row[last]) || !beginsWithLetter(this->Row[last]))
  {
    return false;
  }
  this->Row.resize(this->Width);
  return true;
}

bool TableRows::addTexts()
{
  if (!this->isNamed() || this->Row.size() != this->FirstFields || this->Row.size() > this->Width)
  {
    return false;
  }
  for (std::size_t i = 0; i < this->Width; ++i)
  {
    const bool isLeftOut = i >= this->Row.size();
    double value = 0;
    if (isTextColumn(this->Names[i]) != isLeftOut ||
      (isLeftOut ? this->isCoordinate(i)
                 : this->Parser.parse(this->Row[i], value) == FieldKind::Text))
    {
      return false;
    }
  }
  this->Row.resize(this->Width);
  return true;
}

void TableRows::readStart()
{
  this->Header = std::make_unique<TableHeader>(this->Path, this->Options);
  constexpr std::size_t mostTexts = 100;
  for (bool isFirst = true; !this->takeLine(isFirst); isFirst = false)
  {
    if (this->Header->texts() > mostTexts)
    {
      this->fail("is the last of 100 lines without two numbers; give a file with one point a "
                 "line.");
    }
  }
  this->refuseMixedCommas();
  this->FirstFields = this->Row.size();
  this->Names = this->Header->namesFor(this->Delimiter, this->Row, this->Lines.lineNumber());
  this->Width = this->isNamed() ? this->Names.size() : this->Row.size();
  if (this->Doubtful > 0 && (!this->isNamed() || this->Header->line() == this->Doubtful))
  {
    throw IOError(this->Path, this->Doubtful,
      "is a title, or a point that lacks a coordinate; correct or remove the line.");
  }
  this->refuseNumberedColumns();
}

bool TableRows::takeLine(bool isFirst)
{
  if (!this->nextLine())
  {
    throw IOError(this->Path,
      this->Header->hasOneColumn() ? "has a single column; x and y are needed."
                                   : "holds no points; give a file with one point a line.");
  }
  this->Delimiter = findDelimiter(withoutTrailingComment(this->Line));
  this->Parser = FieldParser(this->Delimiter);
  this->split();
  std::int64_t count = 0;
  const bool isCount = this->Row.size() == 1 && parseInteger(this->Row[0], count);
  if (!this->Count && (isCount || (isFirst && this->startsWithCounts(count))))
  {
    this->Count = count;
    return false;
  }
  this->cutTrailingComment();
  const std::ptrdiff_t numbers = this->count(FieldKind::Number);
  if (numbers > 1 || (numbers > 0 && this->count(FieldKind::Text) == 0))
  {
    return true;
  }
  if (this->Header->hasNames() && !this->Header->tells(this->Line))
  {
    this->Delimiter = numbers > 0 ? this->Delimiter : this->Header->delimiter();
    this->Parser = FieldParser(this->Delimiter);
    this->split();
    return !TableHeader::areUnits(this->Line);
  }
  if (this->Header->texts() == 0 || !TableHeader::areUnits(this->Line))
  {
    this->Header->addText(this->Lines.lineNumber(), this->Line);
    this->Doubtful = this->mayBePoint() ? this->Lines.lineNumber() : this->Doubtful;
  }
  return false;
}

bool TableRows::mayBePoint()
{
  const std::string_view first = trimField(this->Row.front());
  const std::size_t mark = std::min(first.find_first_of(".,"), first.size());
  const bool hasDecimals = mark + 1 < first.size();
  return this->Row.size() > 1 && this->Parser.isNumber(first) &&
    (hasDecimals || this->count(FieldKind::Missing) > 0);
}

std::ptrdiff_t TableRows::count(FieldKind kind)
{
  return std::count_if(this->Row.begin(), this->Row.end(),
    [&](std::string_view field)
    {
      double value = 0;
      return this->Parser.parse(field, value) == kind;
    });
}

void TableRows::cutTrailingComment()
{
  const std::string_view bare = withoutTrailingComment(this->Line);
  if (bare.size() < this->Line.size())
  {
    const std::ptrdiff_t numbers = this->count(FieldKind::Number);
    this->split(bare);
    if (this->count(FieldKind::Number) < numbers)
    {
      this->split();
    }
  }
}

void TableRows::refuseMixedCommas() const
{
  if (this->Delimiter != ',')
  {
    return;
  }
  std::size_t commas = 0;
  std::size_t followed = 0;
  for (std::size_t at = this->Line.find(','); at != std::string_view::npos;
       at = this->Line.find(',', at + 1))
  {
    ++commas;
    followed += at + 1 < this->Line.size() && this->Line[at + 1] == ' ' ? 1 : 0;
  }
  const bool areIntegers = std::all_of(this->Row.begin(), this->Row.end(),
    [](std::string_view field) { return wholeNumber<std::int64_t>(trimField(field)).has_value(); });
  if (areIntegers && followed > 0 && followed < commas)
  {
    this->fail("has commas with and without a blank after them, of which some may be decimal "
               "commas; write decimal points.");
  }
}

void TableRows::refuseNumberedColumns() const
{
  const std::size_t first = trimField(this->Row[0]).empty() ? 1 : 0;
  bool areCounted = !this->isNamed() && this->Delimiter == ',' && this->Row.size() > 2 + first;
  for (std::size_t i = first; i < this->Row.size(); ++i)
  {
    areCounted = areCounted && trimField(this->Row[i]) == std::to_string(i - first);
  }
  if (areCounted && this->Options.X.empty() && (first == 1 || !this->nextIsWhole()))
  {
    this->fail("may be a point or numbers of columns, as pandas writes them; remove the line, or "
               "name the columns.");
  }
}

bool TableRows::nextIsWhole() const
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(openablePath(this->Path), ignored))
  {
    return true;
  }
  FileLines lines(this->Path);
  std::string_view line;
  while (lines.lineNumber() < this->Lines.lineNumber() + 1)
  {
    if (!lines.next(line))
    {
      return true;
    }
  }
  return line.find('.') == std::string_view::npos;
}

bool TableRows::startsWithCounts(std::int64_t& points) const
{
  std::int64_t edges = -1;
  std::error_code ignored;
  if (this->Row.size() != 2 || !parseInteger(this->Row[0], points) || points < 1 ||
    !parseInteger(this->Row[1], edges) || edges != 0 ||
    !std::filesystem::is_regular_file(openablePath(this->Path), ignored))
  {
    return false;
  }
  FileLines lines(this->Path);
  std::string_view line;
  std::int64_t count = -1; // not counting this one
  while (lines.next(line) && count <= points)
  {
    const bool isEmpty = line.find_first_not_of(" \t") == std::string_view::npos;
    count += isEmpty || isComment(line) ? 0 : 1;
  }
  return count == points;
}

void TableRows::chooseColumns()
{
  const bool isUnknown = !this->isNamed() && this->Options.X.empty() && !this->Options.AsIs;
  if (isUnknown && this->Width > 2 && this->isText(this->Row[0]))
  {
    this->failForNumbers();
  }
  this->Choice = tipp::chooseColumns(this->Path, this->Names, this->Width, this->Options);
  if (this->Row.size() > this->Width && !isEmptyField(this->Row.back()))
  {
    this->FirstFields = this->Width; // its last text has delimiters in it
  }
  if (this->Row.size() != this->Width)
  {
    this->fitRow();
  }
  std::vector<std::string> names = this->Names;
  this->Changed = makeDifferent(names);
  for (std::size_t i = 0; i < this->Width; ++i)
  {
    if (i == this->Choice.X || i == this->Choice.Y)
    {
      continue;
    }
    const bool isHeight = i == this->Choice.Z;
    this->Height = isHeight ? this->Further.size() : this->Height;
    const bool isNameless = names.empty() || names[i].empty();
    this->Further.push_back({ i,
      !isNameless  ? names[i]
        : isHeight ? "z"
                   : "column" + std::to_string(i) });
  }
  this->Height = this->Choice.Z ? this->Height : this->Further.size();
}

double TableRows::coordinate(std::size_t index)
{
  double value = 0;
  const FieldKind kind = this->parse(index, value);
  if (kind == FieldKind::Text)
  {
    this->fail("'" + shown(this->Row[index]) +
      "' is not a number; correct the line or choose other columns for x and y.");
  }
  if (isRoundedInteger(this->Row[index], value))
  {
    this->fail("'" + std::string(trimField(this->Row[index])) +
      "' is an integer beyond 2^53 that a double cannot hold; subtract an offset from the "
      "column.");
  }
  return value; // the caller counts points that are not finite
}

} // namespace tipp
