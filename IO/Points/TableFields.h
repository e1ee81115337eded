// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTableFields_h
#define tippTableFields_h

#include "Files/TextFile.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace tipp
{

/// What a field of a table holds.
enum class FieldKind
{
  Number,
  Empty,
  Missing, ///< a word for a missing value, such as NULL, n/a or nan
  Text
};

/// Parses the fields of a table, and remembers which commas it has taken for decimal ones.
class FieldParser
{
public:
  /// Numbers may have decimal commas unless commas are the delimiter.
  explicit FieldParser(char delimiter = ' ')
    : Delimiter(delimiter)
  {
  }

  /// Sets `value`, to NaN unless the field is a number.
  FieldKind parse(std::string_view field, double& value)
  {
    return parseNumber(field, value) && value == value ? FieldKind::Number
                                                       : this->parseUnusual(field, value);
  }

  bool isNumber(std::string_view field)
  {
    double value = 0;
    return this->parse(field, value) == FieldKind::Number;
  }

  char delimiter() const { return this->Delimiter; }

  /// Whether a number had a decimal comma since the last call.
  bool takeComma()
  {
    const bool had = this->HadComma;
    this->HadComma = false;
    return had;
  }

  /// The first number such as 1,234, which may be 1.234 or 1234; empty: none, or another number of
  /// the file has told that commas are decimal.
  std::string unclear() const { return this->IsClear ? "" : this->Unclear; }

private:
  FieldKind parseUnusual(std::string_view field, double& value);
  bool parseDecimalComma(std::string_view field, double& value);

  char Delimiter;
  bool HadComma = false;
  bool IsClear = false;
  std::string Unclear;
};

/// Whether a field has nothing in it, not even quotes.
inline bool isEmptyField(std::string_view field)
{
  return field.find_first_not_of(" \t\r") == std::string_view::npos;
}

/// Whether a field may be the beginning of a text without quotes.
inline bool beginsWithLetter(std::string_view field)
{
  const std::size_t start = std::min(field.find_first_not_of(" \t"), field.size());
  const auto first = static_cast<unsigned char>(start < field.size() ? field[start] : ' ');
  return std::isalpha(first) != 0 || first > 0x7F;
}

/// Finds the delimiter of a row of numbers: the one with which most fields are numbers.
char findDelimiter(std::string_view line);

/// The delimiters that tables have, in the order in which equally good ones are tried.
inline constexpr std::string_view delimiters = ";\t ,";

/// Whether a line, which begins with this character after blanks, is a comment: #, %, !, >, //, or
/// a single semicolon.
bool isComment(std::string_view line);

/// A comment without the characters that begin it.
std::string_view withoutCommentMarks(std::string_view line);

/// The line up to a comment at its end, which begins with # or ! after a blank or a tab, and
/// without the blanks, or the tab, before it.
std::string_view withoutTrailingComment(std::string_view line);

/// A name as it stands in a header, in UTF-8 and without blanks and quotes around it and control
/// characters. Text that is not UTF-8 is taken as Latin-1.
std::string cleanName(std::string_view field);

} // namespace tipp

#endif
