// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionConstraints_h
#define tippPartitionConstraints_h

#include "Constraints/Constraint.h"
#include "Constraints/CrossedTriangles.h"
#include "Constraints/PieceEnds.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Worker.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

/// Inserts pieces of constraints while the points are triangulated. If a partition contains both
/// ends of a piece, and all triangles that the piece crosses are interior, it is inserted into the
/// partition's mesh, which is in the processor's cache and has neighbours. Interior triangles are
/// final, and different partitions have no triangle in common, so the result is the same as if the
/// pieces were inserted afterwards. Other pieces are left for later, and the interior triangles
/// that they cross are recorded. An editor throws CrossingFound where pieces cross; of two pieces
/// that cross, either an editor or a job of retriangulateJobs() finds the other's edge in its way.
class PartitionConstraints
{
public:
  /// `others`: the positions of ends that are no points, whose ids follow those of the points.
  PartitionConstraints(PointsView points, const std::vector<ConstraintPiece>& pieces, int threads,
    std::vector<Point2> others = {});

  /// Makes a thread's editor. The kernel's coordinates have been multiplied by `factor`.
  std::unique_ptr<PartitionEditor> makeEditor(double factor);

  bool isDone(std::size_t piece) const { return this->Done[piece] != 0; }

  /// Whether one of the piece's ends lies in the partition: then Interior::Crossings has all
  /// interior triangles of the partition that the piece crosses, unless it is done.
  bool isKnown(std::int64_t piece, PartitionIndex partition) const
  {
    const Ends& ends = this->EndsOf[std::size_t(piece)];
    return partition >= 0 && (ends.Partition[0] == partition || ends.Partition[1] == partition);
  }

  /// A crossed triangle, counted among the interior ones of its partition, and a piece.
  using Crossing = std::pair<std::size_t, std::int64_t>;

  /// A partition's interior triangles.
  struct Interior
  {
    Octagon Bounds;                  ///< of all
    std::vector<Crossing> Crossings; ///< ascending, each once
  };
  const Interior& interiorOf(PartitionIndex partition) const
  {
    return this->Interiors.at(partition);
  }
  /// Vertices in the interior of pieces, also of those that are left for later.
  std::vector<CrossedTriangles::Touch>& touches() { return this->Touches; }
  const std::vector<CrossedTriangles::Touch>& touches() const { return this->Touches; }

private:
  class Editor;

  /// Each end is written by the thread that has its partition, while others read.
  struct Ends
  {
    std::array<std::atomic<PartitionIndex>, 2> Partition{ -1, -1 };
    std::array<DelaunayKernel::Index, 2> Vertex{};
  };

  Point2 at(PointId id) const
  {
    const std::size_t count = this->Points.size();
    return std::size_t(id) < count ? this->Points[std::size_t(id)]
                                   : this->Others[std::size_t(id) - count];
  }

  PointsView Points;
  std::vector<Point2> Others;
  const std::vector<ConstraintPiece>& Pieces;
  PieceEnds EndPoints;
  std::vector<Ends> EndsOf;
  std::vector<char> Done;
  std::mutex Mutex;
  std::vector<CrossedTriangles::Touch> Touches;
  std::unordered_map<PartitionIndex, Interior> Interiors;
};

} // namespace tipp

#endif
