// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleTaker_h
#define tippTriangleTaker_h

#include "Partitioned/PointRows.h"
#include "Predicates/Point2.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Receives the final triangles of a triangulation out of core, instead of a mesh on disk. What it
/// keeps must survive the process if the run is to be resumed.
class TriangleTaker
{
public:
  virtual ~TriangleTaker() = default;

  /// Equal for takers that do the same in another run.
  virtual std::string identity() const = 0;

  /// About how many bytes of disk it needs where its files are.
  virtual std::uint64_t fileBytes(
    const Box2& bounds, const std::vector<std::string>& columns) const = 0;

  /// Before the first triangles, when the points are known; on all ranks. `files`: how the paths of
  /// files begin that stay until the end of the run; all ranks see them.
  virtual void begin(
    const Box2& bounds, const std::vector<std::string>& columns, const std::string& files) = 0;

  /// Triangles of points in rows; each of the whole triangulation once, or again in a resumed run.
  /// `name`: of this part; the same when it is made again. Called by several threads at once.
  virtual void take(const std::string& name, const double* rows, const PointRowLayout& layout,
    std::size_t points, const std::vector<TriangleRange>& triangles) = 0;

  /// When all are taken; on the first rank. False if `progress` ended it.
  virtual bool end(const std::function<bool(double)>& progress) = 0;
};

} // namespace tipp

#endif
