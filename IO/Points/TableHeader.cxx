// SPDX-License-Identifier: BSD-3-Clause
#include "Points/TableHeader.h"

#include "Files/IOError.h"
#include "Points/ReadPoints.h"
#include "Points/TableColumns.h"
#include "Points/TableFields.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace tipp
{
namespace
{

using Names = std::vector<std::string>;
using Fields = std::vector<std::string_view>;

constexpr std::size_t mostLines = 100; ///< comments that are kept, and names that are split

Names cleanNames(const Fields& fields)
{
  Names names;
  std::transform(fields.begin(), fields.end(), std::back_inserter(names), cleanName);
  return names;
}

/// Units, and words such as "No", belong to the name before them: "Pt No E (m) N (m)" is three
/// names.
Names withUnitsJoined(const Names& words)
{
  Names names;
  bool isOpen = false;
  for (const std::string& word : words)
  {
    const bool begins = !word.empty() && (word[0] == '(' || word[0] == '[');
    if (!names.empty() && (begins || isOpen || isOneName(names.back(), word)))
    {
      names.back() += " " + word;
    }
    else
    {
      names.push_back(word);
    }
    isOpen = (begins || isOpen) && word.find_first_of(")]") == std::string::npos;
  }
  return names;
}

/// Splits at two blanks or more, since a name may have single ones within it.
Names splitAtGaps(std::string_view line)
{
  Names names;
  for (std::size_t at = line.find_first_not_of(' '); at != std::string_view::npos;)
  {
    const std::size_t end = std::min(line.find("  ", at), line.size());
    names.push_back(cleanName(line.substr(at, end - at)));
    at = line.find_first_not_of(' ', end);
  }
  return names;
}

void addSplits(std::string_view line, char delimiter, std::vector<Names>& splits)
{
  Fields fields;
  // Names between commas, semicolons or tabs may have blanks.
  const bool areListed = line.find_first_of(",;\t") != std::string_view::npos;
  const bool isKnown = delimiter != ' ' && line.find(delimiter) != std::string_view::npos;
  const std::string all = isKnown ? std::string(1, delimiter) : areListed ? ";\t," : " ";
  for (const char candidate : all)
  {
    splitFields(line, candidate, fields);
    while (fields.size() > 1 && isEmptyField(fields.back()))
    {
      fields.pop_back();
    }
    Names names = cleanNames(fields);
    if (names.size() > 1 && candidate == ';' && line.substr(0, 2) == "; ")
    {
      names.erase(names.begin()); // a comment mark
    }
    splits.push_back(candidate == ' ' ? withUnitsJoined(names) : names);
  }
  if (!areListed)
  {
    splits.push_back(splitAtGaps(line));
  }
}

/// The ways to split a header, the likeliest ones first.
std::vector<Names> splitsOf(std::string_view line, char delimiter)
{
  std::vector<Names> splits;
  const std::string_view bare = withoutTrailingComment(line);
  if (bare.size() < line.size())
  {
    addSplits(bare, delimiter, splits);
  }
  const bool hasNames =
    std::any_of(splits.begin(), splits.end(), [](const Names& names) { return names.size() > 1; });
  if (!hasNames) // "Point #" may be a name
  {
    addSplits(line, delimiter, splits);
  }
  const std::size_t colon = line.find(": "); // "Columns: x y z"
  if (colon != std::string_view::npos)
  {
    addSplits(line.substr(colon + 2), delimiter, splits);
  }
  return splits;
}

FieldKind kindOf(std::string_view field, char delimiter)
{
  double value = 0;
  return FieldParser(delimiter).parse(field, value);
}

bool isQuoted(std::string_view field)
{
  const std::size_t start = field.find_first_not_of(" \t");
  return start != std::string_view::npos && field[start] == '"';
}

/// Whether the last names are texts, which the row leaves out, and all its fields are values.
bool leavesOutTexts(const Names& names, const Fields& row, char delimiter)
{
  return row.size() < names.size() &&
    std::all_of(names.begin() + std::ptrdiff_t(row.size()), names.end(), isTextColumn) &&
    std::none_of(names.begin(), names.begin() + std::ptrdiff_t(row.size()), isTextColumn) &&
    std::all_of(row.begin(), row.end(),
      [&](std::string_view field) { return kindOf(field, delimiter) == FieldKind::Number; });
}

/// Whether the last name is that of a text with delimiters in it: the other fields are no texts
/// unless their names say so.
bool endsWithLongText(const Names& names, const Fields& row, char delimiter)
{
  return names.size() > 2 && names.size() < row.size() && isTextColumn(names.back()) &&
    beginsWithLetter(row[names.size() - 1]) &&
    kindOf(row[names.size() - 1], delimiter) == FieldKind::Text &&
    !std::all_of(row.begin() + std::ptrdiff_t(names.size()), row.end(),
      [&](std::string_view field) { return kindOf(field, delimiter) == FieldKind::Number; });
}

/// R writes no name for the first column, which holds the names of the rows, in quotes.
bool isRTable(const Names& names, const Fields& row)
{
  return names.size() + 1 == row.size() && columnRole(names[0]) != ColumnRole::Id &&
    isQuoted(row[0]) && std::none_of(row.begin() + 1, row.end(), isQuoted);
}

/// Finds names for the row among the splits: as many as it has fields; fewer if its last fields are
/// empty, or one text; one fewer if its first field is a name in quotes, as in R's tables.
std::optional<Names> suited(const std::vector<Names>& splits, const Fields& row, char delimiter)
{
  for (const Names& names : splits)
  {
    if (names.size() == row.size())
    {
      // Without a first name and a last field, either may be beside the table.
      const bool isUnclear = names.front().empty() && isEmptyField(row.back());
      return isUnclear ? std::nullopt : std::make_optional(names);
    }
  }
  for (const Names& names : splits)
  {
    if (names.size() < 2 || names.front().empty())
    {
      continue;
    }
    const bool endsEmpty = names.size() < row.size() &&
      std::all_of(row.begin() + std::ptrdiff_t(names.size()), row.end(), isEmptyField);
    if (endsEmpty || (names.size() > 1 && leavesOutTexts(names, row, delimiter)) ||
      endsWithLongText(names, row, delimiter))
    {
      return names;
    }
    if (names.size() > 1 && isRTable(names, row))
    {
      Names more = names;
      more.insert(more.begin(), "");
      return more;
    }
  }
  return std::nullopt;
}

/// Whether the names are those of coordinates and points, rather than words of a sentence.
bool areMostlyKnown(const Names& names)
{
  const auto count = [&](bool (*suits)(ColumnRole))
  {
    return std::count_if(
      names.begin(), names.end(), [&](const std::string& name) { return suits(columnRole(name)); });
  };
  const auto known = count([](ColumnRole role) { return role != ColumnRole::None; });
  const auto coordinates =
    count([](ColumnRole role) { return role != ColumnRole::None && role != ColumnRole::Id; });
  return coordinates > 0 && 2 * known >= std::ptrdiff_t(names.size());
}

bool isList(const std::string& line)
{
  return line.find_first_of(";,\t") != std::string::npos;
}

bool haveRole(const Names& names)
{
  return std::any_of(names.begin(), names.end(),
    [](const std::string& name) { return columnRole(name) != ColumnRole::None; });
}

/// Whether all fields are units, such as "m" or "[deg]".
bool areUnits(const Fields& fields)
{
  constexpr std::array<std::string_view, 33> units = { "m", "mm", "cm", "dm", "km", "ft", "feet",
    "usft", "us ft", "ftus", "in", "yd", "deg", "degree", "degrees", "\xc2\xb0", "dd", "rad", "gon",
    "metre", "metres", "meter", "meters", "degrees_north", "degrees_east", "text", "string", "real",
    "integer", "int", "float", "double", "s" };
  bool hasUnit = false;
  for (const std::string_view field : fields)
  {
    std::string unit = lowerCase(cleanName(field));
    if (unit.size() > 2 && (unit.front() == '(' || unit.front() == '['))
    {
      unit = unit.substr(1, unit.size() - 2);
    }
    const bool isUnit = std::find(units.begin(), units.end(), unit) != units.end();
    hasUnit = hasUnit || isUnit;
    if (!isUnit && !unit.empty() && unit != "-")
    {
      return false;
    }
  }
  return hasUnit;
}

} // namespace

bool TableHeader::areAsked(const Names& names) const
{
  const auto has = [&](const std::string& name)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  return !this->Options.X.empty() && !this->Options.Y.empty() && has(this->Options.X) &&
    has(this->Options.Y);
}

bool TableHeader::tells(const Names& names) const
{
  if (names.size() < 2)
  {
    return false;
  }
  try
  {
    return this->areAsked(names) || (!this->Options.AsIs && findCoordinates(names));
  }
  catch (const std::invalid_argument&)
  {
    return true; // it names too many
  }
}

bool TableHeader::tells(std::string_view line) const
{
  const std::vector<Names> splits = splitsOf(line, delimiters[0]);
  return std::any_of(
    splits.begin(), splits.end(), [this](const Names& names) { return this->tells(names); });
}

bool TableHeader::areUnits(std::string_view line)
{
  Fields fields;
  return std::any_of(delimiters.begin(), delimiters.end(),
    [&](char candidate)
    {
      splitFields(line, candidate, fields);
      return tipp::areUnits(fields);
    });
}

/// The delimiter with which the line tells the columns.
char TableHeader::delimiterOf(std::string_view line) const
{
  Fields fields;
  const auto found = std::find_if(delimiters.begin(), delimiters.end(),
    [&](char candidate)
    {
      splitFields(line, candidate, fields);
      return this->tells(cleanNames(fields));
    });
  return found == delimiters.end() ? ' ' : *found;
}

void TableHeader::addText(std::int64_t number, std::string_view line)
{
  if (this->tells(line))
  {
    this->Known = std::ptrdiff_t(this->Texts.size());
    this->Delimiter = this->delimiterOf(line);
  }
  this->Texts.push_back({ number, std::string(line) });
}

bool TableHeader::hasOneColumn() const
{
  return !this->Texts.empty() &&
    std::all_of(this->Texts.begin(), this->Texts.end(),
      [](const TextLine& line)
      { return trimField(line.Text).find_first_of(delimiters) == std::string_view::npos; });
}

void TableHeader::addComment(std::int64_t number, std::string_view line)
{
  if (this->Comments.size() == mostLines)
  {
    this->Comments.erase(this->Comments.begin());
  }
  this->Comments.push_back({ number, std::string(withoutCommentMarks(line)) });
  const std::string& text = this->Comments.back().Text;
  if (this->tells(text))
  {
    this->DoesCommentTell = true;
    this->Delimiter = this->delimiterOf(text);
  }
}

void TableHeader::failToSuit(
  const TextLine& line, char delimiter, std::size_t fields, std::int64_t number) const
{
  const std::vector<Names> splits = splitsOf(line.Text, delimiter);
  const auto told = std::find_if(
    splits.begin(), splits.end(), [this](const Names& names) { return this->tells(names); });
  const Names& names = told == splits.end() ? splits.front() : *told;
  throw IOError(this->Path, number,
    "has " + std::to_string(fields) + " fields, but line " + std::to_string(line.Number) +
      " names " + std::to_string(names.size()) + " columns (" + listOf(names) +
      "); correct one of them, or remove the names and choose the columns with --x, --y and --z.");
}

Names TableHeader::fromComments(char delimiter, const Fields& row, std::int64_t number) const
{
  const TextLine* unsuited = nullptr;
  for (auto line = this->Comments.rbegin(); line != this->Comments.rend(); ++line)
  {
    const std::vector<Names> splits = splitsOf(line->Text, delimiter);
    auto names = suited(splits, row, delimiter);
    if (!names && line->Text[0] == '\t') // it may belong to the comment mark
    {
      names = suited(splitsOf(line->Text.substr(1), delimiter), row, delimiter);
      // Unless the first name is missing, and a text at the end is left out.
      const bool isUnclear =
        names && isTextColumn(names->back()) && kindOf(row.back(), delimiter) == FieldKind::Number;
      names = isUnclear ? std::nullopt : names;
    }
    if (names && this->tells(*names))
    {
      this->Line = line->Number;
      return *names;
    }
    // A comment with a few words more may be a sentence.
    constexpr std::size_t few = 2;
    const bool isUnsuited = std::any_of(splits.begin(), splits.end(),
      [&](const Names& other)
      {
        return other.size() <= row.size() + few &&
          (this->tells(other) || areMostlyKnown(other) || (isList(line->Text) && haveRole(other)));
      });
    unsuited = !unsuited && isUnsuited ? &*line : unsuited;
  }
  if (unsuited && this->Options.X.empty())
  {
    this->failToSuit(*unsuited, delimiter, row.size(), number);
  }
  return {};
}

/// The last line of text may hold names that tell nothing, or be a title.
Names TableHeader::fromTitle(char delimiter, const Fields& row, std::int64_t number) const
{
  const TextLine& line = this->Texts.back();
  const std::vector<Names> splits = splitsOf(line.Text, delimiter);
  const auto names = suited(splits, row, delimiter);
  const bool isChosen = this->Options.AsIs || !this->Options.X.empty() || !this->Options.Y.empty();
  if (names && (isChosen || delimiter != ' ' || row.size() > 2 || haveRole(*names)))
  {
    this->Line = line.Number;
    return *names;
  }
  constexpr std::size_t few = 2;
  for (const Names& other : splits)
  {
    const bool isNear = other.size() <= row.size() + few;
    if (!names && !isChosen && isNear &&
      (areMostlyKnown(other) || (other.size() > 2 && (isList(line.Text) || haveRole(other)))))
    {
      this->failToSuit(line, delimiter, row.size(), number);
    }
  }
  return {};
}

Names TableHeader::namesFor(char delimiter, const Fields& row, std::int64_t number) const
{
  if (this->Known >= 0)
  {
    const TextLine& line = this->Texts[std::size_t(this->Known)];
    const auto names = suited(splitsOf(line.Text, delimiter), row, delimiter);
    if (!names)
    {
      this->failToSuit(line, delimiter, row.size(), number);
    }
    this->Line = line.Number;
    return *names;
  }
  Names names = this->Options.AsIs ? Names() : this->fromComments(delimiter, row, number);
  return names.empty() && !this->Texts.empty() ? this->fromTitle(delimiter, row, number) : names;
}

} // namespace tipp
