// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFilePoints_h
#define tippFilePoints_h

#include "Npy/NpyFile.h"
#include "Points/PointStream.h"
#include "Points/ReadPoints.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
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

/// A text file, read in blocks.
std::unique_ptr<FilePoints> streamTextPoints(const std::string& path, const PointOptions& options);

/// Parses "uniform:COUNT", which stands for that many uniform points instead of a file; returns 0
/// for other names.
std::int64_t generatedCount(const std::string& name);
std::unique_ptr<FilePoints> streamUniformPoints(std::int64_t count);

/// Reads the rows of an n x 2 or n x 3 array of float64 or float32 in order. Throws IOError.
class NpyPointRows
{
public:
  NpyPointRows(const std::string& path, const PointOptions& options);

  std::int64_t rows() const { return this->Reader.rows(); }
  void skip(std::int64_t rows) { this->Reader.skipRows(rows); }

  /// The name of the column that is neither x nor y, if there are three.
  const std::vector<std::string>& further() const { return this->Further; }

  /// Reads the next rows: x and y interleaved, and the third column to `further`, which is null if
  /// there is none.
  void read(std::size_t count, double* xy, double* further);

private:
  template <typename Scalar>
  void readRows(std::size_t count, double* xy, double* further);

  NpyReader Reader;
  std::size_t Width;
  ColumnChoice Choice;
  std::vector<std::string> Further;
};

/// Points from an .npy table of two or three columns, named x, y and z. Reads share `part` of
/// `parts` of its rows.
PointTable readNpyPoints(
  const std::string& path, const PointOptions& options, int part = 0, int parts = 1);

/// The points of a LAS or LAZ file, read in blocks: x, y, and the columns z, intensity,
/// classification, gps_time, red, green, blue and nir, if the file's format has them. Throws
/// IOError.
std::unique_ptr<FilePoints> openLasPoints(const std::string& path, const PointOptions& options);

} // namespace tipp

#endif
