// SPDX-License-Identifier: BSD-3-Clause
#include "Points/TableFields.h"

#include <array>
#include <cmath>
#include <limits>

namespace tipp
{
namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

bool isDigit(char c)
{
  return c >= '0' && c <= '9';
}

/// Words for missing values in the tables of databases, spreadsheets, R, Python and C's and
/// Fortran's output, in lower case.
constexpr std::array<std::string_view, 36> missingWords = { "na", "n/a", "n.a.", "#n/a", "<na>",
  "null", "<null>", "(null)", "nil", "none", "nan", "-nan", "+nan", "nat", "nanq", "nans",
  "missing", "nodata", "no data", "no_data", "void", "undefined", "\\n", "-", "--", "---", "?", ".",
  "#value!", "#div/0!", "#ref!", "#num!", "#name?", "#null!", "#nv", "n/v" };

/// "*" and more stars, as Fortran writes a number that does not fit, are missing, too.
bool isMissingWord(std::string_view lower)
{
  return std::find(missingWords.begin(), missingWords.end(), lower) != missingWords.end() ||
    lower.substr(0, 4) == "nan(" || lower.substr(0, 5) == "-nan(" ||
    lower.find_first_not_of('*') == std::string_view::npos;
}

/// Microsoft's spellings: 1.#INF, -1.#IND, 1.#QNAN, perhaps with further digits.
bool parseMicrosoft(std::string_view lower, double& value)
{
  const bool isNegative = lower.substr(0, 1) == "-";
  lower.remove_prefix(isNegative || lower.substr(0, 1) == "+" ? 1 : 0);
  if (lower.substr(0, 3) != "1.#")
  {
    return false;
  }
  lower.remove_prefix(3);
  while (!lower.empty() && isDigit(lower.back()))
  {
    lower.remove_suffix(1);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  value = lower != "inf" ? notANumber : isNegative ? -infinity : infinity;
  return lower == "inf" || lower == "ind" || lower == "qnan" || lower == "snan";
}

/// Fortran's double precision: 1.5D+01.
bool parseFortran(std::string_view lower, double& value)
{
  const std::size_t letter = lower.find('d');
  if (letter == std::string_view::npos || letter == 0 || letter + 1 == lower.size() ||
    lower.find_first_not_of("0123456789.+-d") != std::string_view::npos)
  {
    return false;
  }
  std::string text(lower);
  text[letter] = 'e';
  return parseNumber(text, value);
}

} // namespace

bool FieldParser::parseDecimalComma(std::string_view field, double& value)
{
  const std::size_t comma = field.find(',');
  const auto isDigitAt = [&](std::size_t at) { return at < field.size() && isDigit(field[at]); };
  if (this->Delimiter == ',' || comma == std::string_view::npos || comma == 0 ||
    !isDigitAt(comma - 1) || !isDigitAt(comma + 1) || field.find('.') != std::string_view::npos)
  {
    return false;
  }
  std::string text(field);
  text[comma] = '.';
  if (!parseNumber(text, value))
  {
    return false;
  }
  // 1,234 may also be a thousand and 234, unlike 0,234 or 1234,567 or 1,23.
  const std::size_t first =
    std::size_t(std::find_if(field.begin(), field.end(), isDigit) - field.begin());
  const std::size_t end = std::min(field.find_first_not_of("0123456789", comma + 1), field.size());
  const bool isUnclear =
    end - comma - 1 == 3 && end == field.size() && comma - first <= 3 && field[first] != '0';
  this->IsClear = this->IsClear || !isUnclear;
  if (isUnclear && this->Unclear.empty())
  {
    this->Unclear = field;
  }
  this->HadComma = true;
  return true;
}

FieldKind FieldParser::parseUnusual(std::string_view field, double& value)
{
  constexpr std::size_t longest = 64;
  field = trimField(field);
  value = notANumber;
  const bool isEmpty = field.empty();
  if (!isEmpty && field.size() <= longest)
  {
    if (this->parseDecimalComma(field, value))
    {
      return FieldKind::Number;
    }
    const std::string lower = lowerCase(field);
    if (parseFortran(lower, value))
    {
      return FieldKind::Number;
    }
    if (isMissingWord(lower) || parseMicrosoft(lower, value))
    {
      return std::isinf(value) ? FieldKind::Number : FieldKind::Missing;
    }
  }
  value = notANumber;
  return isEmpty ? FieldKind::Empty : FieldKind::Text;
}

char findDelimiter(std::string_view line)
{
  std::vector<std::string_view> fields;
  const auto count = [&](char candidate)
  {
    FieldParser parser(candidate);
    splitFields(line, candidate, fields);
    return std::count_if(
      fields.begin(), fields.end(), [&](std::string_view field) { return parser.isNumber(field); });
  };
  // Texts may hold blanks and numbers; between blanks, numbers may have decimal commas.
  if (count(';') > 1)
  {
    return ';';
  }
  if (count('\t') > 1)
  {
    return '\t';
  }
  const auto numbers = count(' ');
  const bool areDecimal = std::all_of(fields.begin(), fields.end(),
    [](std::string_view field)
    { return field.find(',') == std::string_view::npos || FieldParser().isNumber(field); });
  if (numbers > 1 && areDecimal)
  {
    return ' ';
  }
  if (count(',') > 1)
  {
    return ',';
  }
  return *std::max_element(
    delimiters.begin(), delimiters.end(), [&](char a, char b) { return count(a) < count(b); });
}

bool isComment(std::string_view line)
{
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const char first = line.empty() ? ' ' : line.front();
  if (first == '#' && isMissingWord(lowerCase(line.substr(0, line.find_first_of(delimiters)))))
  {
    return false; // a row that begins with #N/A
  }
  return first == '#' || first == '%' || first == '!' || first == '>' ||
    line.substr(0, 2) == "//" || (first == ';' && std::count(line.begin(), line.end(), ';') == 1);
}

std::string_view withoutCommentMarks(std::string_view line)
{
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  line.remove_prefix(std::min(line.find_first_not_of(line.substr(0, 1)), line.size()));
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  return line;
}

std::string_view withoutTrailingComment(std::string_view line)
{
  for (std::size_t at = 1; at < line.size(); ++at)
  {
    const bool isAfterBlank = line[at - 1] == ' ' || line[at - 1] == '\t';
    if (isAfterBlank && (line[at] == '#' || line[at] == '!') && isComment(line.substr(at)))
    {
      // A tab before blanks may begin an empty last field.
      const std::size_t end =
        line[at - 1] == '\t' ? at - 1 : line.find_last_not_of(' ', at - 1) + 1;
      return line.substr(0, end);
    }
  }
  return line;
}

std::string cleanName(std::string_view field)
{
  field = trimField(field);
  std::string name;
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    const bool isDoubled = field[i] == '"' && i + 1 < field.size() && field[i + 1] == '"';
    i += isDoubled ? 1 : 0;
    name += std::iscntrl(static_cast<unsigned char>(field[i])) != 0 ? ' ' : field[i];
  }
  return utf8Of(trimField(name));
}

} // namespace tipp
