// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadPoints_h
#define tippReadPoints_h

#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

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

  /// Keeps the points with a flag: "withheld", "synthetic" or "overlap".
  void keep(const std::string& flag)
  {
    this->KeepWithheld = this->KeepWithheld || flag == "withheld";
    this->KeepSynthetic = this->KeepSynthetic || flag == "synthetic";
    this->KeepOverlap = this->KeepOverlap || flag == "overlap";
  }

  /// Whether something is selected that only LAS files have.
  bool isGiven() const { return !this->Classes.empty() || this->Kind != Returns::All; }

  /// A text that is equal for equal selections.
  std::string text() const
  {
    std::string text = std::to_string(int(this->Kind)) + (this->KeepWithheld ? "w" : "") +
      (this->KeepSynthetic ? "s" : "") + (this->KeepOverlap ? "o" : "");
    for (const int number : this->Classes)
    {
      text += "," + std::to_string(number);
    }
    return text;
  }
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

class PointStream;

/// Options of reading points.
struct PointOptions
{
  /// Which columns are x and y: a name in the file's header, or a column index from 0. Empty:
  /// columns with the usual names (x, y; lon, lat; longitude, latitude; easting, northing), else
  /// the first two.
  std::string X;
  std::string Y; ///< likewise
  LasSelection Las = {};
  Thinning Thin = {}; ///< applied to the points of all files together
  int Threads = 1;    ///< threads that decode LAS files; 0: OpenMP's default
  /// Whether points that are generated have a column z.
  bool InSpace = false;
  /// Names of the columns besides x and y to read, if the file has them; nullopt: all.
  std::optional<std::vector<std::string>> Columns = {};

  bool wants(const std::string& column) const
  {
    return !this->Columns ||
      std::find(this->Columns->begin(), this->Columns->end(), column) != this->Columns->end();
  }
};

/// Reads points by the file's extension:
/// .npy (n x 2 or n x 3, float64 or float32); .csv, .txt, .xyz (one point per line, columns
/// separated by comma, semicolon, tab or spaces, with or without a first line of names or with the
/// count); .las, .laz (see openLasPoints); .14, .grd (ADCIRC grids: nodes and depth); any format
/// that VTK reads (points and point data, a column for each component). Throws IOError.
VTKTIPPIO_EXPORT PointTable readPoints(const std::string& path, const PointOptions& options = {});

/// Reads the points of several files, in their order. Throws IOError.
VTKTIPPIO_EXPORT PointTable readPoints(
  const std::vector<std::string>& paths, const PointOptions& options);

/// Reads all points within the stream's limits. Throws IOError.
VTKTIPPIO_EXPORT PointTable readAllPoints(PointStream& stream);

/// Reads share `part` of `parts` of the files' points: consecutive points if reading can start at
/// any of them (.npy, .las), else all for part 0 and none for the others. Throws IOError.
VTKTIPPIO_EXPORT PointTable readPointsShare(
  const std::vector<std::string>& paths, const PointOptions& options, int part, int parts);

/// The indices of the columns that are x and y.
struct ColumnChoice
{
  std::size_t X = 0;
  std::size_t Y = 1;
};

/// Finds x and y among a file's columns; `names` is empty or as long as `count`. Throws IOError if
/// there are fewer than two columns or the options ask for one that is not there.
ColumnChoice chooseColumns(const std::string& path, const std::vector<std::string>& names,
  std::size_t count, const PointOptions& options);

} // namespace tipp

#endif
