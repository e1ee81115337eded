// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTableRows_h
#define tippTableRows_h

#include "Files/TextFile.h"
#include "Points/ReadPoints.h"
#include "Points/TableColumns.h"
#include "Points/TableFields.h"
#include "Points/TableHeader.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

/// Tells whether the first column of a table without names holds numbers of points, which must not
/// be taken as x: integers that increase, or that differ beside others with decimals or a code.
class PointNumberTest
{
public:
  /// `width`: the number of columns.
  explicit PointNumberTest(std::size_t width)
    : Width(width)
    , IsOpen(width > 2)
  {
  }

  /// Adds a row, whose third field is the number `height` (NaN if it is none).
  void add(const std::vector<std::string_view>& row, double height, FieldParser& parser)
  {
    if (!this->IsOpen)
    {
      return;
    }
    const auto number = wholeNumber<std::int64_t>(trimField(row[0]));
    if (!number || *number < 0)
    {
      this->IsOpen = false;
      return;
    }
    this->Increases = this->Increases && (this->Rows == 0 || *number > this->Last);
    this->IsCounted = this->IsCounted && (this->Rows == 0 || *number == this->Last + 1);
    this->Last = *number;
    this->AreDifferent =
      this->AreDifferent && (this->Seen.size() == mostSeen || this->Seen.insert(*number).second);
    this->testThirdColumn(double(*number), height);
    this->SecondHasDecimals = this->SecondHasDecimals ||
      row[1].find('.') != std::string_view::npos || row[1].find(',') != std::string_view::npos;
    this->HasCode = this->HasCode || (this->Width > 4 && this->isText(row.back(), parser));
    ++this->Rows;
    this->IsOpen = this->Increases || this->AreDifferent;
  }

  bool holdsNumbers() const
  {
    constexpr std::int64_t few = 3;
    if (this->IsOpen && this->Rows > 0 &&
      (this->AreFar || (this->AreDifferent && this->SecondHasDecimals)))
    {
      return true;
    }
    const bool isIncreasing =
      this->Rows > few && (this->Width > 3 ? this->Increases : this->IsCounted);
    return this->IsOpen && this->Rows >= few &&
      (isIncreasing || (this->AreDifferent && this->HasCode));
  }

private:
  static bool isText(std::string_view field, FieldParser& parser)
  {
    double value = 0;
    return parser.parse(field, value) == FieldKind::Text;
  }

  /// The third column, which would be the height, may be a coordinate, too.
  void testThirdColumn(double number, double height)
  {
    constexpr double highest = 50000;
    constexpr double factor = 100;
    this->AreFar = this->AreFar && height > highest && height > factor * number;
  }

  static constexpr std::size_t mostSeen = 1000;

  std::size_t Width;
  bool IsOpen;
  bool Increases = true;
  bool IsCounted = true;
  bool AreDifferent = true;
  bool AreFar = true;
  bool SecondHasDecimals = false;
  bool HasCode = false;
  std::int64_t Rows = 0;
  std::int64_t Last = 0;
  std::set<std::int64_t> Seen;
};

/// Reads the rows of a text file of points in order; readTextPoints() describes the format.
class TableRows
{
public:
  struct Column
  {
    std::size_t Index;
    std::string Name;
  };

  /// Reads the lines before the first row. Throws IOError.
  TableRows(const std::string& path, const PointOptions& options);

  /// Reads the next row; returns false at the end. Throws IOError if a row has another width, or if
  /// there are not as many rows as the first line announces.
  bool next()
  {
    if (this->Rows > 0)
    {
      if (!this->nextLine())
      {
        this->requireCount();
        return false;
      }
      this->split();
      if (this->Row.size() != this->Width || this->FirstFields != this->Width)
      {
        this->fitRow();
      }
    }
    ++this->Rows;
    return true;
  }

  /// The coordinates of the row, NaN if they are missing; throw IOError if they are text.
  double x() { return this->coordinate(this->Choice.X); }
  double y() { return this->coordinate(this->Choice.Y); }

  /// Whether x or y is missing, other than as nan.
  bool lacksCoordinate();

  FieldKind value(const Column& column, double& value) { return this->parse(column.Index, value); }
  std::string_view field(const Column& column) const { return trimField(this->Row[column.Index]); }

  /// Throws IOError if the row mixes decimal points and decimal commas.
  void requireOneKindOfDecimals()
  {
    if (!this->Parser.takeComma())
    {
      return;
    }
    for (const std::string_view field : this->Row)
    {
      if (field.find('.') != std::string_view::npos && this->Parser.isNumber(field))
      {
        this->fail("has decimal commas and '" + shown(field) +
          "', which has a decimal point or thousands; write all numbers in one way.");
      }
    }
    this->Parser.takeComma();
  }

  /// Tells whether the first column is a number of the point, while the columns are not known.
  std::optional<PointNumberTest> numberTest() const;
  void add(PointNumberTest& test)
  {
    double height = 0;
    if (this->Width > 2)
    {
      this->parse(2, height);
    }
    test.add(this->Row, height, this->Parser);
  }

  [[noreturn]] void failForNumbers() const;

  /// Throws IOError unless it is clear that commas are decimal commas.
  void requireClearCommas() const;

  [[noreturn]] void fail(const std::string& problem) const;

  static std::string shown(std::string_view field);

  /// All columns but x and y.
  const std::vector<Column>& further() const { return this->Further; }
  /// The index of the heights in further(); its size: there are none.
  std::size_t height() const { return this->Height; }
  bool isNamed() const { return !this->Names.empty(); }
  std::size_t width() const { return this->Width; }
  std::int64_t lineNumber() const { return this->Lines.lineNumber(); }
  const std::vector<std::string>& changedNames() const { return this->Changed; }
  /// An estimate of the number of rows; 0: unknown.
  std::int64_t expectedRows() const { return this->Lines.expectedLines(); }

  /// What the columns are taken for.
  std::string describe() const;
  /// Whether the columns are called x, y and z, or x and y if there are no others.
  bool areObvious() const;

private:
  FieldKind parse(std::size_t column, double& value)
  {
    const FieldKind kind = this->Parser.parse(this->Row[column], value);
    return kind == FieldKind::Text && column + 1 == this->Width ? this->parseLast(value) : kind;
  }
  FieldKind parseLast(double& value);
  std::string nameOf(std::size_t column) const;
  void requireCount() const;

  /// Reads the next line that is neither empty nor a comment.
  bool nextLine();

  void split() { this->split(this->Line); }
  void split(std::string_view line);

  /// Makes a row have the width of the table, where it is certain how; else throws IOError.
  void fitRow();
  bool fits();
  /// Drops empty fields at the end, as the first row has them.
  bool dropEmptyFields();
  bool isText(std::string_view field);
  bool isCoordinate(std::size_t column) const;

  /// The last column is a text with delimiters in it.
  bool joinText();

  /// The row leaves out texts at its end, as the first one does.
  bool addTexts();

  /// Reads the lines before the first point. Afterwards Row holds the first point's fields.
  void readStart();

  /// Takes the next line before or at the first point; returns true if it is the point.
  bool takeLine(bool isFirst);
  std::ptrdiff_t count(FieldKind kind);
  /// Whether a line of text may be a point that lacks a coordinate: it begins with a number that
  /// has decimals, or has a word for a missing value.
  bool mayBePoint();
  /// Leaves out a comment at the end of the first row, unless it holds numbers.
  void cutTrailingComment();

  /// "12,5, 13,5" may be two numbers with decimal commas.
  void refuseMixedCommas() const;

  /// pandas writes the numbers of columns without names: "0,1,2", or ",0,1,2" with an index.
  void refuseNumberedColumns() const;

  /// Whether all fields of the second row are integers.
  bool nextIsWhole() const;

  /// The first line may hold the number of points and 0, the number of edges, or be a point; so the
  /// lines after it are counted.
  bool startsWithCounts(std::int64_t& points) const;
  void chooseColumns();
  double coordinate(std::size_t index);

  std::string Path;
  PointOptions Options;
  FileLines Lines;
  std::string_view Line;
  char Delimiter = ' ';
  FieldParser Parser;
  std::unique_ptr<TableHeader> Header;
  std::vector<std::string_view> Row;
  std::size_t Width = 0;
  /// The fields of all rows, which may have empty ones at the end, or lack texts there.
  std::size_t FirstFields = 0;
  std::int64_t Rows = 0;
  std::optional<std::int64_t> Count;
  std::int64_t Doubtful = 0; ///< a line before the first row that may be a point; 0: there is none
  std::vector<std::string> Names;   ///< as they stand in the file; empty: there are none
  std::vector<std::string> Changed; ///< names that are not unique
  ColumnChoice Choice;
  std::vector<Column> Further;
  std::size_t Height = 0;
};

} // namespace tipp

#endif
