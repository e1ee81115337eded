// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTextRows_h
#define tippTextRows_h

#include "Files/FileLines.h"
#include "Points/ColumnChoice.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

/// The rows of a text file of points, as TextPoints.h describes it, one after the other.
class TextRows
{
public:
  struct Column
  {
    std::size_t Index;
    std::string Name;
  };

  /// Reads up to the first row, which next() then gives. Throws IOError.
  TextRows(const std::string& path, const PointOptions& options);

  /// False at the end, where the number of rows is that which the first line announces, if it does;
  /// else throws IOError, as for a row of another width.
  bool next();

  /// Of the row. Throw IOError.
  double x() const { return this->coordinate(this->Choice.X); }
  double y() const { return this->coordinate(this->Choice.Y); }

  enum class Value
  {
    Number,
    Missing, ///< NaN
    Text
  };
  Value value(const Column& column, double& value) const;

  /// All but x and y.
  const std::vector<Column>& further() const { return this->Further; }
  std::size_t width() const { return this->Width; }
  /// About how many there are; 0: not known.
  std::int64_t expectedRows() const { return this->Lines.expectedLines(); }

private:
  bool nextLine();
  void requireLine();
  void split();
  void readStart();
  bool startsWithCounts(std::int64_t& points) const;
  bool startsWithNames() const;
  void chooseColumns(const PointOptions& options);
  bool parse(std::string_view field, double& value) const;
  double coordinate(std::size_t index) const;
  void checkCount() const;

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

} // namespace tipp

#endif
