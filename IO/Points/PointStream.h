// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointStream_h
#define tippPointStream_h

#include "Points/PointTable.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

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
};

/// Appends the points of a block to a table with the same columns.
VTKTIPPIO_EXPORT void append(const PointBlock& block, PointTable& table);

/// Reads points from files of any size, block by block, in any number of passes. Not thread-safe.
class VTKTIPPIO_EXPORT PointStream
{
public:
  virtual ~PointStream();

  /// Reads the next points, at most `most`; returns false at the end. Throws IOError.
  virtual bool next(PointBlock& block, std::size_t most) = 0;

  /// Starts a new pass. Throws IOError if a file has changed since the first one.
  virtual void rewind() = 0;

  /// The number of points if reading can start at any of them, else -1.
  virtual std::int64_t divisible() const = 0;

  /// Limits the passes from the next rewind() on to points [first, end).
  virtual void limitTo(std::int64_t first, std::int64_t end) = 0;

  /// Names of the columns besides x and y.
  virtual std::vector<std::string> columns() const = 0;

  /// The number of points that the options rejected in the last complete pass, for example by their
  /// class.
  virtual std::int64_t leftOut() const { return 0; }

  /// An upper bound of the number of points; 0: unknown.
  virtual std::int64_t most() const { return 0; }

  /// The number of points that thinning removed, known after the first pass.
  virtual std::int64_t thinnedOut() const { return 0; }

  /// The coordinate reference system of the points: WKT or "EPSG:code", or empty.
  virtual std::string crs() const { return ""; }

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

} // namespace tipp

#endif
