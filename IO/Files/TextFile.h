// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTextFile_h
#define tippTextFile_h

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

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

  /// An upper bound of the number of lines left.
  std::int64_t remainingLines() const;

private:
  std::string_view Rest;
  std::int64_t Number = 0;
};

/// Parses a whole field as a number, ignoring blanks and quotes around it.
bool parseNumber(std::string_view field, double& value);
bool parseInteger(std::string_view field, std::int64_t& value);

/// Splits a line at a delimiter, or at any run of blanks if the delimiter is a space. A field in
/// double quotes may contain the delimiter.
void splitFields(std::string_view line, char delimiter, std::vector<std::string_view>& fields);

/// Removes blanks and one pair of quotes around the field.
std::string_view trimField(std::string_view field);

} // namespace tipp

#endif
