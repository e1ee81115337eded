// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFilePoints_h
#define tippFilePoints_h

#include "Files/TextFile.h"
#include "Points/PointStream.h"
#include "Points/ReadPoints.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

/// The points of one file, block by block.
class FilePoints
{
public:
  virtual ~FilePoints() = default;
  /// Adds up to `most` points to an empty block; returns false at the end. The block's vectors keep
  /// their capacity from the previous call.
  virtual bool next(PointBlock& block, std::size_t most) = 0;
  virtual void rewind() = 0;
  /// The number of points if skip() takes no time, else -1.
  virtual std::int64_t divisible() const { return -1; }
  /// Skips the next points.
  virtual void skip(std::int64_t) {}
  virtual std::vector<std::string> columns() const = 0;
  /// An upper bound of the number of points; 0: unknown.
  virtual std::int64_t most() const { return 0; }
  /// The number of points that the options rejected in the last complete pass.
  virtual std::int64_t leftOut() const { return 0; }
  /// The coordinate reference system: see PointStream.
  virtual std::string crs() const { return ""; }
};

/// Opens a file by its extension. Throws IOError.
std::unique_ptr<FilePoints> openFilePoints(const std::string& path, const PointOptions& options);

/// The points of a table instead of a file.
std::unique_ptr<FilePoints> openTable(PointTable table);

/// A text file, read in blocks.
std::unique_ptr<FilePoints> streamTextPoints(const std::string& path, const PointOptions& options);

/// Parses "uniform:COUNT", which stands for that many uniform points instead of a file; returns 0
/// for other names.
std::int64_t generatedCount(const std::string& name);

/// The points of a LAS or LAZ file, read in blocks: x, y, and the columns z, intensity,
/// classification, gps_time, red, green, blue and nir, if the file's format has them. Throws
/// IOError.
std::unique_ptr<FilePoints> openLasPoints(const std::string& path, const PointOptions& options);

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
  TextRows(const std::string& path, const PointOptions& options);

  /// Reads the next row; returns false at the end. Throws IOError if a row has another width, or if
  /// there are not as many rows as the first line announces.
  bool next();

  /// The coordinates of the row; throw IOError if they are not numbers.
  double x() const { return this->coordinate(this->Choice.X); }
  double y() const { return this->coordinate(this->Choice.Y); }

  enum class Value
  {
    Number,
    Missing, ///< NaN
    Text
  };
  Value value(const Column& column, double& value) const;

  /// All columns but x and y.
  const std::vector<Column>& further() const { return this->Further; }
  std::size_t width() const { return this->Width; }
  /// An estimate of the number of rows; 0: unknown.
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

/// Reads points from text, one per line. The delimiter is detected: semicolon, comma, tab or
/// blanks; numbers may have decimal commas unless commas separate the columns. The first line may
/// hold names, the number of points, or the numbers of points and of edges (0). Empty lines and
/// lines that start with # are skipped. Another column is kept if all its values are numbers or
/// missing (NaN); without names the first is z and the others column<number>.
PointTable readTextPoints(const std::string& path, const PointOptions& options);

/// Whether the path names text: .csv, .tsv, .txt, .xyz or .pts; .gz, .xz or .zst (compressed text);
/// or "-" (standard input).
bool isTextPath(const std::string& path);

} // namespace tipp

#endif
