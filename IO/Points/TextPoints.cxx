// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

/// A number with a decimal comma, as "-1,5".
bool parseDecimalComma(std::string_view field, double& value)
{
  constexpr std::size_t longest = 64;
  field = trimField(field);
  const std::size_t comma = field.find(',');
  const auto isDigit = [&](std::size_t at)
  { return at < field.size() && field[at] >= '0' && field[at] <= '9'; };
  if (comma == std::string_view::npos || comma == 0 || field.size() > longest ||
    !isDigit(comma - 1) || !isDigit(comma + 1) || field.find('.') != std::string_view::npos)
  {
    return false;
  }
  std::string text(field);
  text[comma] = '.';
  return parseNumber(text, value);
}

/// Whether blanks separate fields with decimal commas, as in "1,5 2,5".
bool hasDecimalCommas(std::string_view line)
{
  std::vector<std::string_view> fields;
  splitFields(line, ' ', fields);
  double value = 0;
  return fields.size() > 1 &&
    std::all_of(fields.begin(), fields.end(),
      [&](std::string_view field)
      { return parseNumber(field, value) || parseDecimalComma(field, value); });
}

char findDelimiter(std::string_view line)
{
  if (line.find(';') == std::string_view::npos && hasDecimalCommas(line))
  {
    return line.find('\t') != std::string_view::npos ? '\t' : ' ';
  }
  for (const char candidate : { ';', ',', '\t' })
  {
    if (line.find(candidate) != std::string_view::npos)
    {
      return candidate;
    }
  }
  return ' ';
}

bool isMissing(std::string_view field)
{
  field = trimField(field);
  return field.empty() || field == "NA" || field == "N/A" || field == "null" || field == "-";
}

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
  const auto [end, error] =
    std::to_chars(digits, digits + sizeof(digits), std::fabs(value), std::chars_format::fixed, 0);
  return error != std::errc() || field != std::string_view(digits, std::size_t(end - digits));
}

std::string_view trimEnd(std::string_view line)
{
  while (!line.empty() && line.back() == ' ')
  {
    line.remove_suffix(1);
  }
  return line;
}

/// Reads the rows of a text file of points in order; readTextPoints() describes the format.
class TextRows
{
public:
  struct Column
  {
    std::size_t Index;
    std::string Name;
  };

  /// Reads the lines before the first row. Throws IOError.
  TextRows(const std::string& path, const PointOptions& options)
    : Path(path)
    , Lines(path)
  {
    this->readStart();
    this->chooseColumns(options);
  }

  /// Reads the next row; returns false at the end. Throws IOError if a row has another width, or if
  /// there are not as many rows as the first line announces.
  bool next()
  {
    if (this->Rows > 0)
    {
      if (!this->nextLine())
      {
        if (this->Count && *this->Count != this->Rows)
        {
          throw IOError(this->Path,
            "announces " + std::to_string(*this->Count) + " points in its first line and holds " +
              std::to_string(this->Rows) + "; copy it again or correct the line.");
        }
        return false;
      }
      this->split();
      if (this->Row.size() != this->Width)
      {
        throw IOError(this->Path, this->Lines.lineNumber(),
          "has " + std::to_string(this->Row.size()) + " columns where the first point has " +
            std::to_string(this->Width) + "; correct or remove the line.");
      }
    }
    ++this->Rows;
    return true;
  }

  /// The coordinates of the row; throw IOError if they are not numbers.
  double x() const { return this->coordinate(this->Choice.X); }
  double y() const { return this->coordinate(this->Choice.Y); }

  enum class Value
  {
    Number,
    Missing, ///< NaN
    Text
  };
  Value value(const Column& column, double& value) const
  {
    const std::string_view field = this->Row[column.Index];
    if (this->parse(field, value))
    {
      return Value::Number;
    }
    value = std::numeric_limits<double>::quiet_NaN();
    return isMissing(field) ? Value::Missing : Value::Text;
  }

  /// All columns but x and y.
  const std::vector<Column>& further() const { return this->Further; }
  std::size_t width() const { return this->Width; }
  /// An estimate of the number of rows; 0: unknown.
  std::int64_t expectedRows() const { return this->Lines.expectedLines(); }

private:
  bool nextLine()
  {
    while (this->Lines.next(this->Line))
    {
      const std::size_t start = this->Line.find_first_not_of(" \t");
      if (start != std::string_view::npos && this->Line[start] != '#')
      {
        return true;
      }
    }
    return false;
  }

  void requireLine()
  {
    if (!this->nextLine())
    {
      throw IOError(this->Path, "holds no points; give a file with one point a line.");
    }
  }

  void split()
  {
    // Files with blanks between columns may have one at the end of a line, too.
    const std::string_view line = this->Delimiter == ' ' ? this->Line : trimEnd(this->Line);
    splitFields(line, this->Delimiter, this->Row);
  }

  /// Reads the lines before the first point. Afterwards Row holds the first point's fields.
  void readStart()
  {
    this->requireLine();
    this->Delimiter = findDelimiter(this->Line);
    this->split();
    std::int64_t count = 0;
    if ((this->Row.size() == 1 && parseInteger(this->Row[0], count)) ||
      this->startsWithCounts(count))
    {
      this->Count = count;
      this->requireLine();
    }
    else if (this->startsWithNames())
    {
      const std::string header(this->Line);
      this->requireLine();
      this->Delimiter = findDelimiter(this->Line);
      splitFields(header, this->Delimiter, this->Row);
      for (const std::string_view name : this->Row)
      {
        this->Names.emplace_back(trimField(name));
      }
    }
    this->Delimiter = findDelimiter(this->Line);
    this->split();
    if (this->Names.size() != this->Row.size())
    {
      this->Names.clear(); // a title
    }
  }

  /// The first line may hold the number of points and 0, the number of edges, or be a point; so the
  /// lines after it are counted.
  bool startsWithCounts(std::int64_t& points) const
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
      const std::size_t start = line.find_first_not_of(" \t");
      count += start != std::string_view::npos && line[start] != '#' ? 1 : 0;
    }
    return count == points;
  }

  /// A point has at least two numbers; a line of names may hold one, such as a year.
  bool startsWithNames() const
  {
    double value;
    return std::count_if(this->Row.begin(), this->Row.end(),
             [&](std::string_view field) { return this->parse(field, value); }) < 2;
  }

  void chooseColumns(const PointOptions& options)
  {
    this->Width = this->Row.size();
    this->Choice = tipp::chooseColumns(this->Path, this->Names, this->Width, options);
    for (std::size_t i = 0; i < this->Width; ++i)
    {
      if (i != this->Choice.X && i != this->Choice.Y)
      {
        const std::string plain = this->Further.empty() ? "z" : "column" + std::to_string(i);
        const bool named = !this->Names.empty() && !this->Names[i].empty();
        this->Further.push_back({ i, named ? this->Names[i] : plain });
      }
    }
  }

  bool parse(std::string_view field, double& value) const
  {
    return parseNumber(field, value) || (this->Delimiter != ',' && parseDecimalComma(field, value));
  }

  double coordinate(std::size_t index) const
  {
    double value = 0;
    if (isMissing(this->Row[index]))
    {
      // The caller counts points that are not finite.
      return std::numeric_limits<double>::quiet_NaN();
    }
    if (!this->parse(this->Row[index], value))
    {
      constexpr std::size_t shown = 40;
      throw IOError(this->Path, this->Lines.lineNumber(),
        "'" + std::string(trimField(this->Row[index]).substr(0, shown)) +
          "' is not a number; correct the line or choose other columns for x and y.");
    }
    if (isRoundedInteger(this->Row[index], value))
    {
      throw IOError(this->Path, this->Lines.lineNumber(),
        "'" + std::string(trimField(this->Row[index])) +
          "' is an integer beyond 2^53 that a double cannot hold; subtract an offset from the "
          "column.");
    }
    return value;
  }

  std::string Path;
  FileLines Lines;
  std::string_view Line;
  char Delimiter = ' ';
  std::vector<std::string_view> Row;
  std::size_t Width = 0;
  std::int64_t Rows = 0;
  std::optional<std::int64_t> Count;
  std::vector<std::string> Names;
  ColumnChoice Choice;
  std::vector<Column> Further;
};

/// A column that may hold only numbers or nothing.
struct NumericColumn
{
  TextRows::Column Column;
  std::vector<double> Values;
  bool HasNumber = false;
};

/// Reads all rows, and thereby finds all errors in the file. Returns the other columns that hold
/// only numbers or nothing, and at least one number. Their values and `xy` stay empty unless
/// `keepsValues`.
std::vector<NumericColumn> readRows(TextRows rows, bool keepsValues, std::vector<double>& xy)
{
  const std::size_t expected = keepsValues ? std::size_t(rows.expectedRows()) : 0;
  xy.reserve(2 * expected);
  std::vector<NumericColumn> columns;
  for (const TextRows::Column& column : rows.further())
  {
    columns.push_back({ column, {} });
    columns.back().Values.reserve(expected);
  }
  const auto keep = [keepsValues](double value, std::vector<double>& values)
  { keepsValues ? values.push_back(value) : void(); };
  while (rows.next())
  {
    keep(rows.x(), xy);
    keep(rows.y(), xy);
    for (std::size_t i = 0; i < columns.size();)
    {
      double value = 0;
      const TextRows::Value kind = rows.value(columns[i].Column, value);
      if (kind == TextRows::Value::Text)
      {
        columns.erase(columns.begin() + std::ptrdiff_t(i));
        continue;
      }
      columns[i].HasNumber = columns[i].HasNumber || kind == TextRows::Value::Number;
      keep(value, columns[i++].Values);
    }
  }
  columns.erase(std::remove_if(columns.begin(), columns.end(),
                  [](const NumericColumn& column) { return !column.HasNumber; }),
    columns.end());
  return columns;
}

class TextFilePoints : public FilePoints
{
public:
  TextFilePoints(const std::string& path, const PointOptions& options)
    : Path(path)
    , Options(options)
  {
    std::vector<double> none;
    for (const NumericColumn& column : readRows(TextRows(path, options), false, none))
    {
      this->Numeric.push_back(column.Column);
    }
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    if (!this->Rows)
    {
      this->Rows.emplace(this->Path, this->Options);
    }
    block.Columns.resize(this->Numeric.size());
    std::size_t count = 0;
    for (; count < most && this->Rows->next(); ++count)
    {
      block.XY.push_back(this->Rows->x());
      block.XY.push_back(this->Rows->y());
      for (std::size_t i = 0; i < this->Numeric.size(); ++i)
      {
        block.Columns[i].push_back(this->valueOf(this->Numeric[i]));
      }
    }
    return count > 0;
  }

  void rewind() override
  {
    this->Rows.reset(); // reopened when needed: there may be many files
  }

  std::vector<std::string> columns() const override
  {
    std::vector<std::string> names;
    for (const TextRows::Column& column : this->Numeric)
    {
      names.push_back(column.Name);
    }
    return names;
  }

private:
  double valueOf(const TextRows::Column& column) const
  {
    double value = 0;
    if (column.Index >= this->Rows->width() ||
      this->Rows->value(column, value) == TextRows::Value::Text)
    {
      throw IOError(this->Path, "has been changed meanwhile; start again.");
    }
    return value;
  }

  const std::string Path;
  const PointOptions Options;
  std::vector<TextRows::Column> Numeric;
  std::optional<TextRows> Rows;
};

} // namespace

bool isTextPath(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return path == "-" || extension == ".csv" || extension == ".tsv" || extension == ".txt" ||
    extension == ".xyz" || extension == ".pts" || extension == ".gz" || extension == ".xz" ||
    extension == ".zst";
}

PointTable readTextPoints(const std::string& path, const PointOptions& options)
{
  PointTable table;
  for (NumericColumn& column : readRows(TextRows(path, options), true, table.XY))
  {
    table.Columns.push_back({ std::move(column.Column.Name), std::move(column.Values) });
  }
  return table;
}

std::unique_ptr<FilePoints> streamTextPoints(const std::string& path, const PointOptions& options)
{
  return std::make_unique<TextFilePoints>(path, options);
}

} // namespace tipp
