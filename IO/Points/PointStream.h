// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointStream_h
#define tippPointStream_h

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

/// Points that follow each other in a stream.
struct PointBlock
{
  std::int64_t First = 0; ///< the id of the first: its place in the stream
  std::vector<double> XY;
  std::vector<std::vector<double>> Columns; ///< as PointStream::columns() has them

  std::size_t size() const { return this->XY.size() / 2; }
};

/// Points from files of any size, block by block and as often as wanted. Not for several threads at
/// once.
class VTKTIPPIO_EXPORT PointStream
{
public:
  virtual ~PointStream();

  /// The next points, at most so many; false at the end. Throws IOError.
  virtual bool next(PointBlock& block, std::size_t most) = 0;

  /// Starts again. Throws IOError if a file is another than at first.
  virtual void rewind() = 0;

  /// The number of points, if a part of them can be read without reading what is before; else -1.
  virtual std::int64_t divisible() const = 0;

  /// From the next rewind() on there are only those from the first one to before the end.
  virtual void limitTo(std::int64_t first, std::int64_t end) = 0;

  /// Names of the columns beside x and y.
  virtual std::vector<std::string> columns() const = 0;

  /// How many points the options have left out in the last whole pass, as those of other classes.
  virtual std::int64_t leftOut() const { return 0; }

  /// There are no more points than this; 0: not known.
  virtual std::int64_t most() const { return 0; }

  /// How many points thinning has left out, once they are read.
  virtual std::int64_t thinnedOut() const { return 0; }

  /// The coordinate reference system of the points: WKT or "EPSG:code", or empty.
  virtual std::string crs() const { return ""; }

  /// What tells whether it is the same input in another run: names, sizes and times of files.
  virtual std::string identity() const = 0;
};

/// One or more files, one after the other: .npy, .las and text are read block by block, other
/// formats a file as a whole, for each pass. Text takes a pass more, at once, which finds its
/// numeric columns. The name "uniform:COUNT" stands for so many points that are uniform in the unit
/// square and made as they are wanted. All must have the same columns. Throws IOError.
VTKTIPPIO_EXPORT std::unique_ptr<PointStream> openPointStream(
  const std::vector<std::string>& paths, const PointOptions& options = {});

/// All points from the start on; reads the next block while take() has one. The block may be
/// changed.
VTKTIPPIO_EXPORT void forEachBlock(
  PointStream& points, std::size_t most, const std::function<void(PointBlock&)>& take);

} // namespace tipp

#endif
