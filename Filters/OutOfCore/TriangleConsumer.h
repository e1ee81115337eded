// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleConsumer_h
#define tippTriangleConsumer_h

#include "Partitioned/GrowingPiece.h"
#include "Predicates/Geometry.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Receives the final triangles of a triangulation out of core instead of a mesh on disk. To resume
/// a run in another process, the consumer must keep its state in files.
class TriangleConsumer
{
public:
  virtual ~TriangleConsumer() = default;

  /// Returns a text that is equal for consumers that do the same, so that a run is resumed with the
  /// same consumer.
  virtual std::string identity() const = 0;

  /// Returns the approximate number of bytes that the consumer needs on the disk of its files.
  virtual std::uint64_t fileBytes(
    const Box2& bounds, const std::vector<std::string>& columns) const = 0;

  /// Called once, on all ranks, when the points are known and before the first triangles. `files`:
  /// prefix for paths of files that stay until the end of the run; all ranks see them. `bounds`: of
  /// the finite points, without those of constraints. `columns`: of the input, beside x and y.
  virtual void begin(
    const Box2& bounds, const std::vector<std::string>& columns, const std::string& files) = 0;

  /// Receives triangles as corners that are indices into `points` rows. The calls together pass
  /// each triangle of the triangulation once, or again if the run is resumed. `name` identifies
  /// this part of the triangles: it is the same when the part is passed again. Called by several
  /// threads at the same time.
  virtual void take(const std::string& name, const double* rows, const PointRowLayout& layout,
    std::size_t points, const std::vector<TriangleRange>& triangles) = 0;

  /// Called on the first rank when all triangles have been passed. Returns false if `progress`
  /// stopped it.
  virtual bool end(const std::function<bool(double)>& progress) = 0;
};

} // namespace tipp

#endif
