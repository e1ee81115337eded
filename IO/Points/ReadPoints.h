// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadPoints_h
#define tippReadPoints_h

#include "Crs/ReferenceSystem.h"
#include "Points/TableColumns.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkDataSet;

namespace tipp
{

/// What a reader has taken from a table, for people.
struct TableReport
{
  std::string Path;
  std::string Columns;    ///< such as "x from 'Easting', y from 'Northing', z from 'Elevation'"
  bool IsObvious = false; ///< the columns are called x, y and z
  std::vector<std::string> Warnings; ///< sentences about values that may not be meant
  std::vector<std::string> Remarks;  ///< sentences about what was left out or changed
};

/// How much of LAS and LAZ files is read where PointOptions::Region or Spacing leaves out the rest.
struct ReadFigures
{
  std::int64_t Files = 0;
  std::int64_t SkippedFiles = 0; ///< of which only the header is read
  std::int64_t Chunks = 0;       ///< of compressed files
  std::int64_t SkippedChunks = 0;
  std::int64_t Points = 0;
  std::int64_t SkippedPoints = 0; ///< not decoded
  /// The bounds of all points, also of those outside of a region, as far as they are known: those
  /// in the header of a LAS file, those of the points read of others.
  Box2 Bounds = Box2::empty();

  void add(const ReadFigures& other)
  {
    this->Files += other.Files;
    this->SkippedFiles += other.SkippedFiles;
    this->Chunks += other.Chunks;
    this->SkippedChunks += other.SkippedChunks;
    this->Points += other.Points;
    this->SkippedPoints += other.SkippedPoints;
    this->Bounds.extend(other.Bounds);
  }
};

/// Points read from a file: x and y interleaved, and the other numeric columns by name.
struct PointTable
{
  /// A named column of numbers.
  struct Column
  {
    std::string Name;
    std::vector<double> Values; ///< one per point
  };

  std::vector<double> XY; ///< x and y of each point, interleaved
  std::vector<Column> Columns;
  std::int64_t LeftOut = 0;    ///< points that the options rejected
  std::int64_t ThinnedOut = 0; ///< points that thinning removed
  std::string Crs;             ///< the coordinate reference system: see PointStream::crs()
  std::vector<TableReport> Reports = {}; ///< one for each file of text
  std::string CrsProblem = {};           ///< see ReferenceSystem::Problem
  ReadFigures Figures = {};

  std::size_t size() const { return this->XY.size() / 2; }
  /// The names of Columns.
  std::vector<std::string> names() const
  {
    std::vector<std::string> names;
    std::transform(this->Columns.begin(), this->Columns.end(), std::back_inserter(names),
      [](const Column& column) { return column.Name; });
    return names;
  }
};

/// Returns the index of the elevation column, which is named z, Z or elevation; the number of
/// columns if there is none.
inline std::size_t findElevation(const std::vector<std::string>& columns)
{
  for (const char* const name : { "z", "Z", "elevation" })
  {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found != columns.end())
    {
      return std::size_t(found - columns.begin());
    }
  }
  return columns.size();
}

/// Returns the index of the column that decides which points are lowest and highest: the elevation,
/// else the depth, else the only column. Returns the number of columns if there is none.
inline std::size_t findRankColumn(const std::vector<std::string>& columns)
{
  const std::size_t elevation = findElevation(columns);
  if (elevation < columns.size() || columns.size() == 1)
  {
    return elevation < columns.size() ? elevation : 0;
  }
  return std::size_t(std::find(columns.begin(), columns.end(), "depth") - columns.begin());
}

/// Whether a height is one of the numbers that mark missing values in rasters and tables, such as
/// -9999.
VTKTIPPIO_EXPORT bool isNoDataMark(double height);

/// The number of values that are NaN or infinite.
inline std::int64_t countMissing(const std::vector<double>& values)
{
  return std::count_if(
    values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
}

/// Which points of a LAS file are read.
struct LasSelection
{
  enum class Returns
  {
    All,
    First,
    Last
  };

  /// Parses the number of a class; nullopt unless it is from 0 to 255.
  VTKTIPPIO_EXPORT static std::optional<int> parseClass(const std::string& text);

  std::vector<int> Classes; ///< empty: all
  Returns Kind = Returns::All;
  bool KeepWithheld = false;
  bool KeepSynthetic = false;
  /// Whether to keep points flagged as overlap of another swath: a flag in formats 6 to 10, class
  /// 12 in others.
  bool KeepOverlap = false;
  bool KeepTruncated = false; ///< whether to read what a file has that ends too early
  bool KeepUncounted = false; ///< whether to read the points beyond the number in the header

  /// Keeps the points with a flag: "withheld", "synthetic" or "overlap"; or "truncated" or
  /// "uncounted" for the members above.
  void keep(const std::string& flag)
  {
    this->KeepWithheld = this->KeepWithheld || flag == "withheld";
    this->KeepSynthetic = this->KeepSynthetic || flag == "synthetic";
    this->KeepOverlap = this->KeepOverlap || flag == "overlap";
    this->KeepTruncated = this->KeepTruncated || flag == "truncated";
    this->KeepUncounted = this->KeepUncounted || flag == "uncounted";
  }

  /// Whether something is selected that only LAS files have.
  bool isGiven() const { return !this->Classes.empty() || this->Kind != Returns::All; }

  /// A text that is equal for equal selections.
  std::string text() const
  {
    std::string text = std::to_string(int(this->Kind)) + (this->KeepWithheld ? "w" : "") +
      (this->KeepSynthetic ? "s" : "") + (this->KeepOverlap ? "o" : "") +
      (this->KeepTruncated ? "t" : "") + (this->KeepUncounted ? "u" : "");
    for (const int number : this->Classes)
    {
      text += "," + std::to_string(number);
    }
    return text;
  }
};

/// The fields that points of several LAS files have when they are to be written again: all of
/// formats 6, 7 or 8, as columns besides those that readers of LAS files give otherwise. A file
/// without one of the fields gives zeros.
struct LasFields
{
  bool HasColour = false;
  bool HasInfrared = false;
  /// The extra bytes, which all files have: LasExtra::key() of each.
  std::vector<std::string> Extras;

  /// Begins the names of the columns with the stored bits of a record.
  static constexpr const char* Prefix = "las:";
  static bool isName(const std::string& column) { return column.compare(0, 4, Prefix) == 0; }
};

/// Thinning: keeps one point in each square of a grid whose lines are at multiples of the cell
/// size.
struct Thinning
{
  enum class Rule
  {
    Lowest,
    Highest,
    Nearest ///< to the centre of the square
  };

  double Cell = 0;           ///< 0: all points are kept
  Rule Keep = Rule::Nearest; ///< which point of a square is kept
  /// The beginning of the path of a temporary file for the squares, if they may not fit in memory;
  /// empty: they are kept in memory.
  std::string File;

  bool isGiven() const { return this->Cell > 0; }
};

/// Options of reading points.
struct PointOptions
{
  /// Which columns are x and y: a name in the file's header, or a column index from 0. Empty: by
  /// findCoordinates(); without names the first two.
  std::string X;
  std::string Y;
  LasSelection Las = {};
  /// 180 or 360: x are longitudes in degrees, which are moved by 360 into [Wrap - 360, Wrap). 0:
  /// no.
  int Wrap = 0;
  Thinning Thin = {}; ///< applied to the points of all files together
  int Threads = 1;    ///< threads that decode LAS and LAZ files; 0: defaultThreads()
  /// Whether points that are generated have a column z.
  bool InSpace = false;
  /// Names of the columns besides x and y to read, if the file has them; nullopt: all.
  std::optional<std::vector<std::string>> Columns = {};
  /// Which column of a text or .npy file is z, like X and Y; empty: by findCoordinates(); without
  /// names the third.
  std::string Z = {};
  /// The layer of a GIS file whose points are read; empty: all layers.
  std::string Layer = {};
  /// The coordinate reference system of the points, whatever the files state; empty: theirs.
  std::string Crs = {};
  /// Whether files in different systems are read together. A Crs allows it, too.
  bool AnyCrs = false;
  /// The value that stands for a missing one in all columns but x and y.
  std::optional<double> NoData = {};
  /// Whether the columns of text are taken as they are, the first two as x and y.
  bool AsIs = false;
  /// The columns of LAS files that are to be written again; then `Columns` must not be given.
  std::optional<LasFields> Fields = {};
  /// The box of the points to read, after Wrap; the others are left out. Of LAS and LAZ files the
  /// parts that cannot have points in it are not read. nullopt: all points.
  std::optional<Box2> Region = {};
  /// For COPC files, the only ones with this: the finest levels are left out if the points of the
  /// others are about this far apart. 0: all levels are read.
  double Spacing = 0;

  bool wants(const std::string& column) const
  {
    return !this->Columns ||
      std::find(this->Columns->begin(), this->Columns->end(), column) != this->Columns->end();
  }
};

/// Reads points by the file's extension (Files/Formats.h). Of VTK's formats, a column for each
/// component of point data; of meshes of models the nodes with their values. Throws IOError.
VTKTIPPIO_EXPORT PointTable readPoints(const std::string& path, const PointOptions& options = {});

/// Reads the points of several files, in their order. Throws IOError.
VTKTIPPIO_EXPORT PointTable readPoints(
  const std::vector<std::string>& paths, const PointOptions& options);

/// Consecutive points of a stream.
struct PointBlock
{
  std::int64_t First = 0; ///< id of the first point: its index in the stream
  std::vector<double> XY; ///< x and y of each point, interleaved
  std::vector<std::vector<double>>
    Columns; ///< one vector per column, in the order of PointStream::columns()

  std::size_t size() const { return this->XY.size() / 2; }
  /// Changes the number of points, not that of the columns.
  void resize(std::size_t points)
  {
    this->XY.resize(2 * points);
    for (std::vector<double>& column : this->Columns)
    {
      column.resize(points);
    }
  }

  /// Removes the points, by index in the block, for which isKept(index) returns false.
  template <typename IsKept>
  void keepIf(const IsKept& isKept)
  {
    std::size_t to = 0;
    for (std::size_t i = 0; i < this->size(); ++i)
    {
      if (isKept(i))
      {
        this->XY[2 * to] = this->XY[2 * i];
        this->XY[2 * to + 1] = this->XY[2 * i + 1];
        for (std::vector<double>& column : this->Columns)
        {
          column[to] = column[i];
        }
        ++to;
      }
    }
    this->resize(to);
  }
};

/// Appends the points of a block to a table with the same columns.
VTKTIPPIO_EXPORT void append(const PointBlock& block, PointTable& table);

/// Reads points block by block, in any number of passes. Not thread-safe.
class VTKTIPPIO_EXPORT PointSource
{
public:
  virtual ~PointSource();

  /// Reads the next points, at most `most`; returns false at the end. Throws IOError.
  virtual bool next(PointBlock& block, std::size_t most) = 0;

  /// Starts a new pass. Throws IOError if a file has changed since the first one.
  virtual void rewind() = 0;

  /// Whether passes from the next rewind() on need the columns, as they do at first. If not, those
  /// in which no value can be missing may have any finite values, where that saves time.
  virtual void needColumns(bool) {}

  /// The number of points if reading can start at any of them, else -1.
  virtual std::int64_t divisible() const { return -1; }

  /// Names of the columns besides x and y.
  virtual std::vector<std::string> columns() const = 0;

  /// The number of points that the options rejected in the last complete pass, for example by their
  /// class.
  virtual std::int64_t leftOut() const { return 0; }

  /// An upper bound of the number of points; 0: unknown.
  virtual std::int64_t most() const { return 0; }

  /// The coordinate reference system of the points; its Problem is a sentence.
  virtual ReferenceSystem referenceSystem() const { return {}; }
  /// Its text: WKT or "EPSG:code", or empty.
  std::string crs() const { return this->referenceSystem().Text; }

  /// What has been taken from tables, known once the source is open.
  virtual std::vector<TableReport> reports() const { return {}; }

  /// How much of LAS and LAZ files is read, known once the source is open.
  virtual ReadFigures readFigures() const { return {}; }
};

/// A stream of the points of one or more inputs of any size, which can be limited to a range.
class VTKTIPPIO_EXPORT PointStream : public PointSource
{
public:
  /// Limits the passes from the next rewind() on to points [first, end).
  virtual void limitTo(std::int64_t first, std::int64_t end) = 0;

  /// The number of points that thinning removed, known after the first pass.
  virtual std::int64_t thinnedOut() const { return 0; }

  /// Identifies the input across runs: names, sizes and times of the files.
  virtual std::string identity() const = 0;
};

/// Opens one or more files as one stream, in their order; all must have the same columns. In each
/// pass .npy, .las and text files are read block by block, other formats as a whole. Opening a text
/// file reads it once to find its numeric columns. The name "uniform:COUNT" stands for that many
/// points, uniform in the unit square or (PointOptions::InSpace) cube, which are generated block by
/// block. Throws IOError.
VTKTIPPIO_EXPORT std::unique_ptr<PointStream> openPointStream(
  const std::vector<std::string>& paths, const PointOptions& options = {});

/// Makes a whole pass: calls take() with each block, and reads the next one meanwhile. take() may
/// change the block.
VTKTIPPIO_EXPORT void forEachBlock(
  PointStream& points, std::size_t most, const std::function<void(PointBlock&)>& take);

/// Returns the points of a stream that thinning keeps, in their order. Of equally good points the
/// first is kept; points that are not finite are all kept. The first pass reads the stream twice.
/// Memory: one bit per point, plus the squares. Throws IOError if the rule needs an elevation and
/// there is none.
std::unique_ptr<PointStream> thinPoints(
  std::unique_ptr<PointStream> points, const Thinning& thinning);

/// The points of a table that thinning keeps, as a stream. Throws IOError as thinPoints().
VTKTIPPIO_EXPORT std::unique_ptr<PointStream> streamTable(
  PointTable table, const Thinning& thinning = {});

/// Reads all points within the stream's limits. Throws IOError.
VTKTIPPIO_EXPORT PointTable readAllPoints(PointStream& stream);

/// Reads share `part` of `parts` of the files' points: consecutive points if reading can start at
/// any of them (.npy and .las, but .npy not within a region), else all for part 0 and none for the
/// others. Throws IOError.
VTKTIPPIO_EXPORT PointTable readPointsShare(
  const std::vector<std::string>& paths, const PointOptions& options, int part, int parts);

/// The points of one file. next() adds points to an empty block, whose vectors keep their capacity
/// from the previous call.
class FilePoints : public PointSource
{
public:
  /// Skips the next points without reading them; call it only if divisible() is not -1.
  virtual void skip(std::int64_t) {}
};

/// Replaces the options' no-data value by NaN.
void clearNoData(const PointOptions& options, std::vector<double>& values);

/// Throws IOError: PointOptions::Spacing needs a COPC file.
[[noreturn]] void refuseSpacing(const std::string& path);

/// Opens a file by its extension. Throws IOError.
std::unique_ptr<FilePoints> openFilePoints(const std::string& path, const PointOptions& options);

/// The points of a file that lie in PointOptions::Region, after PointOptions::Wrap.
std::unique_ptr<FilePoints> keepRegion(
  std::unique_ptr<FilePoints> points, const std::string& path, const PointOptions& options);

/// The points of a table instead of a file.
std::unique_ptr<FilePoints> openTable(PointTable table);

/// A text file, read in blocks.
std::unique_ptr<FilePoints> streamTextPoints(const std::string& path, const PointOptions& options);

/// Parses "uniform:COUNT", which stands for that many uniform points instead of a file; returns 0
/// for other names.
std::int64_t generatedCount(const std::string& name);

/// Generates `count` points of Distribution::Uniform with seed 1; in space they have a column z.
std::unique_ptr<FilePoints> openGeneratedPoints(std::int64_t count, bool inSpace);

/// The points of a LAS or LAZ file, read in blocks: x, y, and the columns z, intensity,
/// classification, gps_time, red, green, blue and nir, if the file's format has them. Throws
/// IOError.
std::unique_ptr<FilePoints> openLasPoints(const std::string& path, const PointOptions& options);

/// The points of a file of a GIS, read in blocks with GDAL: those of all layers or of one, also the
/// parts of multipoints. Columns: z, if the points have a z or the options name an attribute for
/// it, and the attributes that are numbers. Features without a point are left out. Throws IOError,
/// always in a build without GDAL.
std::unique_ptr<FilePoints> openGisPoints(const std::string& path, const PointOptions& options);

/// Reads points from text, one per line. The delimiter is detected: semicolon, comma, tab or
/// blanks; numbers may have decimal commas unless commas separate the columns. Lines above the
/// first row may hold names, also behind a comment mark, units, a title, the number of points, or
/// the numbers of points and of edges (0). Empty lines and comments are skipped.
///
/// The column of heights becomes z, and is also kept under its own name. Other columns are kept if
/// they hold numbers; without names they are called column<number>. A few fields of text in a
/// column of numbers are missing values (NaN), which are counted in the report; more of them are an
/// error in z or in a column that is asked for, else the column is left out.
PointTable readTextPoints(const std::string& path, const PointOptions& options);

/// Reads the points of a file of VTK as pointsOf() returns them. Throws IOError if reading fails,
/// and always in a build without VTK.
VTKTIPPIO_EXPORT PointTable readVtkPoints(const std::string& path);

/// Converts a data set's points and numeric point data to a table with a column z; an array of
/// several components becomes columns name_0, name_1 ...
VTKTIPPIO_EXPORT PointTable pointsOf(vtkDataSet* data);

/// Finds x, y and z among a file's columns; `names` is empty or as long as `count`. Throws IOError
/// if there are fewer than two columns, the options ask for one that is not there, or the names do
/// not tell.
ColumnChoice chooseColumns(const std::string& path, const std::vector<std::string>& names,
  std::size_t count, const PointOptions& options);

} // namespace tipp

#endif
