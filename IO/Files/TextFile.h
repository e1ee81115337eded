// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTextFile_h
#define tippTextFile_h

#include "vtkTIPPIOModule.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace tipp
{

/// The path at which a text input can be opened, as often as needed: for "-", the standard input,
/// that of a temporary copy, made when it is first asked for; else the path itself. Throws IOError.
std::string openablePath(const std::string& path);

/// Returns the content of a text file or of a pipe. Throws IOError if it cannot be read or is not
/// text.
std::string readTextFile(const std::string& path);

/// Iterates over the lines of a text, without their ends (\n or \r\n) and without a byte order
/// mark.
class LineReader
{
public:
  explicit LineReader(std::string_view text);

  bool next(std::string_view& line);
  std::int64_t lineNumber() const { return this->Number; }

  /// The text after the lines read so far.
  std::string_view rest() const { return this->Rest; }

private:
  std::string_view Rest;
  std::int64_t Number = 0;
};

/// The text with lower-case letters; letters beyond ASCII stay.
std::string lowerCase(std::string_view text);

/// The text in UTF-8: text that is not UTF-8 is taken as Latin-1.
std::string utf8Of(std::string_view text);

/// The number that the whole text is, without blanks around it; nullopt for other text.
template <typename Number>
std::optional<Number> wholeNumber(std::string_view text)
{
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? std::make_optional(value) : std::nullopt;
}

/// Parses a whole field as a number, ignoring blanks and quotes around it.
bool parseNumber(std::string_view field, double& value);
/// Parses a whole field as an integer.
bool parseInteger(std::string_view field, std::int64_t& value);
/// Also parses a whole number that is written with a decimal point or an exponent, such as 3.0, up
/// to 2^53.
bool parseWhole(std::string_view field, std::int64_t& value);

/// The number in decimal with 17 digits, from which it can be restored.
VTKTIPPIO_EXPORT std::string exactText(double value);
/// The shortest decimal number from which it can be restored, such as 0.01.
VTKTIPPIO_EXPORT std::string shortText(double value);

/// Splits a line at a delimiter, or at any run of blanks if the delimiter is a space. A field in
/// double quotes may contain the delimiter, and two quotes for one, as in RFC 4180.
/// Returns false if a quote at the beginning of a field does not end.
bool splitFields(std::string_view line, char delimiter, std::vector<std::string_view>& fields);

/// Removes blanks and one pair of quotes around the field.
std::string_view trimField(std::string_view field);

/// Reads a text file as rows of numbers, separated by blanks. Errors are IOErrors that name the
/// line.
class NumberRows
{
public:
  /// Reads the whole file. `kind` completes the message "check that it is ...". If there is a
  /// `comment`, this character begins a comment, and lines without a field are skipped.
  NumberRows(const std::string& path, std::string kind, char comment = '\0');

  /// Reads the next row, which must have at least `fields` fields; `what` is for errors.
  void next(std::size_t fields, const char* what);
  /// Reads the next row with any number of fields; returns false at the end of the file.
  bool nextIfAny();
  /// Throws IOError if the row has less than `fields` fields; `what` is for the message.
  void require(std::size_t fields, const char* what) const;
  std::size_t fields() const { return this->Row.size(); }
  std::string_view text(std::size_t field) const { return this->Row[field]; }
  double number(std::size_t field) const;
  std::int64_t integer(std::size_t field) const;
  /// An upper bound of the number of lines after the row.
  std::int64_t remainingLines() const { return this->Total - this->Lines.lineNumber(); }
  std::int64_t lineNumber() const { return this->Lines.lineNumber(); }

  [[noreturn]] void fail(const std::string& problem) const;

private:
  const std::string Path;
  const std::string Kind;
  const char Comment;
  const std::string Text;
  LineReader Lines;
  const std::int64_t Total; ///< computed once, because files are long
  std::vector<std::string_view> Row;
};

/// Reads the lines of a text file of any size or of a pipe, without their ends (\n, \r\n, or \r if
/// there is no \n) and without a byte order mark. A .gz, .xz or .zst file is decompressed by the
/// program gzip, xz or zstd.
class VTKTIPPIO_EXPORT FileLines
{
public:
  /// Reads blocks of `blockBytes` bytes. Throws IOError if the file cannot be read or is not text.
  explicit FileLines(const std::string& path, std::size_t blockBytes = std::size_t(1) << 20);

  /// Reads the next line, valid until the next call. Returns false at the end. Throws IOError if
  /// the file cannot be read or a line exceeds 64 MiB.
  bool next(std::string_view& line);
  std::int64_t lineNumber() const { return this->Number; }

  /// The approximate number of lines, from the file's size and first block; 0 for a pipe.
  std::int64_t expectedLines() const { return this->Expected; }

private:
  bool readMore();
  void endDecompression();

  std::string Path;
  std::string Program; ///< the decompressor; empty: none
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> File;
  const std::size_t BlockBytes;
  std::vector<char> Buffer;
  std::size_t Begin = 0; ///< start of the bytes that have not been returned
  std::size_t End = 0;
  char LineEnd = '\n';
  std::int64_t Number = 0;
  std::int64_t Expected = 0;
};

} // namespace tipp

#endif
