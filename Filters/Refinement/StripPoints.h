// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStripPoints_h
#define tippStripPoints_h

#include "Files/PagedMemory.h"
#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"
#include "Refinement/NodeStrips.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// The points of a stream with a column, by strip of a mesh. If there are several strips, the
/// stream is read once and the points are kept in `memory`, or in the process's memory if it is
/// null. Values that are not finite are left out.
class StripPoints
{
public:
  /// The arguments must outlive this. Throws IOError and WorkAborted.
  StripPoints(
    const NodeStrips& strips, PointStream& points, std::size_t column, PagedMemory* memory);

  using Take = std::function<void(const std::vector<Point3>&, const std::vector<double>&)>;

  /// Calls take(positions, values) for blocks of at most `most` points, in the order of the stream:
  /// all that may be in the strip's triangles. Throws IOError and WorkAborted.
  void forBlocks(std::size_t strip, std::size_t most, const Take& take);

private:
  struct Item
  {
    Point2 Position;
    double Value;
  };
  static constexpr std::size_t Chunk = 1024; ///< items of a strip that lie together

  void forStream(std::size_t most, const Take& take);
  void store(Point3 position, double value);
  void add(std::size_t strip, const Item& item);

  const NodeStrips& Strips;
  PointStream& Points;
  const std::size_t Column;
  PagedMemory* const Memory;
  std::vector<Buffer<Item>> Blocks;               ///< each of ChunksInBlock chunks
  std::vector<std::vector<std::uint32_t>> Chunks; ///< by strip: its chunks, in order
  std::vector<std::size_t> Counts;                ///< by strip: its items
  std::uint32_t ChunkEnd = 0;
};

} // namespace tipp

#endif
