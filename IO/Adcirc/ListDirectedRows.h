// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippListDirectedRows_h
#define tippListDirectedRows_h

#include "Files/TextFile.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

/// Parses a whole field as Fortran reads a real number: its exponent may begin with E, D or Q, or
/// with its sign alone, such as 1.5D+01 or 1.5-101.
bool parseFortranNumber(std::string_view field, double& value);

/// Reads a text file in rows, as Fortran's list-directed input, read(unit, *), does. Values are
/// separated by blanks or a comma; "3*0.5" stands for three values; a slash ends a row. Empty lines
/// are skipped, a row may continue on the next line, and values after those asked for are ignored.
/// Values that Fortran would leave unchanged, as between two commas, are errors. Errors are
/// IOErrors that name the line.
class ListDirectedRows
{
public:
  /// Reads the whole file. `kind` completes the message "check that it is ...".
  ListDirectedRows(const std::string& path, std::string kind);

  /// Reads a line as text.
  std::string_view title();
  /// Reads the next row, which must have at least `fields` values; `what` is for errors.
  void next(std::size_t fields, const char* what);
  /// The number of values in the row's lines.
  std::size_t fields() const { return this->Row.size(); }
  bool isNumber(std::size_t field) const;
  double number(std::size_t field) const;
  std::int64_t integer(std::size_t field) const;
  /// The text after the row.
  std::string_view rest() const { return this->Lines.rest(); }
  /// An upper bound of the number of lines after the row.
  std::int64_t remainingLines() const { return this->Total - this->Lines.lineNumber(); }

  /// Whether all lines have been read, and the last one has no end: its last value may be cut off.
  bool endsInLine() const;
  /// The same, or a line was asked for that does not follow.
  bool isCutOff() const;

  [[noreturn]] void fail(const std::string& problem) const;

private:
  bool isAtEnd() const
  {
    return this->rest().find_first_not_of(" \t\r\n") == std::string_view::npos;
  }
  void addLine(std::string_view line);
  void addValue(std::string_view text);
  void addValues(std::size_t count, std::string_view text);
  [[noreturn]] void failToRead(std::size_t field, const char* kind) const;

  const std::string Path;
  const std::string Kind;
  const std::string Text;
  LineReader Lines;
  const std::int64_t Total;          ///< computed once, because files are long
  std::int64_t RowLine = 0;          ///< the line on which the row begins
  std::vector<std::string_view> Row; ///< an empty text: no value is given
  bool ExpectsValue = true;          ///< no value since the row's beginning or the last comma
  bool IsEnded = false;              ///< by a slash
  bool IsBeyondEnd = false;          ///< a row after the last line was asked for
};

} // namespace tipp

#endif
