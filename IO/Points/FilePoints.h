// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFilePoints_h
#define tippFilePoints_h

#include "Points/PointStream.h"

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
  /// Appends to a block without points; false at the end. The block's columns have the memory of
  /// the one before.
  virtual bool next(PointBlock& block, std::size_t most) = 0;
  virtual void rewind() = 0;
  /// The number of points if skip() takes no time, else -1.
  virtual std::int64_t divisible() const { return -1; }
  /// Leaves out the next ones.
  virtual void skip(std::int64_t) {}
  virtual std::vector<std::string> columns() const = 0;
  /// There are no more points than this; 0: not known.
  virtual std::int64_t most() const { return 0; }
  /// How many points of the file the options have left out in the last whole pass.
  virtual std::int64_t leftOut() const { return 0; }
  /// The coordinate reference system: see PointStream.
  virtual std::string crs() const { return ""; }
};

/// By the file's extension. Throws IOError.
std::unique_ptr<FilePoints> openFilePoints(const std::string& path, const PointOptions& options);

/// A text file, read in blocks.
std::unique_ptr<FilePoints> streamTextPoints(const std::string& path, const PointOptions& options);

/// "uniform:1000000" is no file but so many uniform points; 0 for other names.
std::int64_t generatedCount(const std::string& name);
std::unique_ptr<FilePoints> generatePointsAsWanted(std::int64_t count);

} // namespace tipp

#endif
