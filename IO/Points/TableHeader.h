// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTableHeader_h
#define tippTableHeader_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

struct PointOptions;

/// The lines above the first row of a table, and the names of the columns in one of them.
class TableHeader
{
public:
  TableHeader(std::string path, const PointOptions& options)
    : Path(std::move(path))
    , Options(options)
  {
  }

  /// Adds a line that holds neither a comment nor a row, which may be names, units or a title.
  void addText(std::int64_t number, std::string_view line);
  void addComment(std::int64_t number, std::string_view line);

  /// Whether a line has told the columns, so that what follows are units and rows.
  bool hasNames() const { return this->Known >= 0 || this->DoesCommentTell; }
  /// The delimiter of that line.
  char delimiter() const { return this->Delimiter; }
  /// The number of lines of text.
  std::size_t texts() const { return this->Texts.size(); }
  /// Whether there are lines of text, and none has several columns.
  bool hasOneColumn() const;

  /// Whether the line itself tells the columns.
  bool tells(std::string_view line) const;
  /// Whether all fields of the line are units, such as "m" or "[deg]".
  static bool areUnits(std::string_view line);

  /// Returns the names of the columns of a table whose first row, in line `number`, has these
  /// fields; empty: there are none. A name that the header lacks is empty. Throws IOError if the
  /// names do not suit the row, or do not tell x and y.
  std::vector<std::string> namesFor(
    char delimiter, const std::vector<std::string_view>& row, std::int64_t number) const;
  /// The line of the names that namesFor() has returned.
  std::int64_t line() const { return this->Line; }

private:
  struct TextLine
  {
    std::int64_t Number;
    std::string Text;
  };

  std::vector<std::string> fromTitle(
    char delimiter, const std::vector<std::string_view>& row, std::int64_t number) const;
  std::vector<std::string> fromComments(
    char delimiter, const std::vector<std::string_view>& row, std::int64_t number) const;
  char delimiterOf(std::string_view line) const;
  bool areAsked(const std::vector<std::string>& names) const;
  bool tells(const std::vector<std::string>& names) const;
  [[noreturn]] void failToSuit(
    const TextLine& line, char delimiter, std::size_t fields, std::int64_t number) const;

  const std::string Path;
  const PointOptions& Options;
  std::vector<TextLine> Texts;
  std::vector<TextLine> Comments;
  std::ptrdiff_t Known = -1; ///< index of the last text that tells the columns
  bool DoesCommentTell = false;
  char Delimiter = ' ';
  mutable std::int64_t Line = 0;
};

} // namespace tipp

#endif
