// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionConstraints_h
#define tippPartitionConstraints_h

#include "Constraints/Constraint.h"
#include "Constraints/CrossedTriangles.h"
#include "Constraints/PieceEnds.h"
#include "Constraints/SegmentTree.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Worker.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

/// Inserts pieces of constraints while the points are triangulated. A piece is inserted into a
/// partition's mesh if the partition has both ends and all triangles that the piece crosses are
/// interior. At this time the mesh is in the processor's cache and has neighbour relations.
/// Interior triangles are final, and partitions have no common triangles, so the result is the same
/// as if the pieces were inserted at the end. Other pieces are left for later, and the interior
/// triangles that they cross are recorded. If two pieces cross, an editor or a job of
/// retriangulateJobs() finds that one blocks the other, and throws CrossingFound.
class PartitionConstraints
{
public:
  /// `others` are the positions of ends that are not points; their ids follow those of the points.
  PartitionConstraints(PointsView points, const std::vector<ConstraintPiece>& pieces, int threads,
    std::vector<Point2> others = {});

  /// Makes the editor of a thread. `factor` is the factor by which the kernel's coordinates have
  /// been multiplied.
  std::unique_ptr<PartitionEditor> makeEditor(double factor);

  bool isDone(std::size_t piece) const { return this->Done[piece] != 0; }

  /// Whether one of the piece's ends is in the partition. Then Interior::Crossings has all interior
  /// triangles of the partition that the piece crosses, unless the piece was inserted.
  bool isKnown(std::int64_t piece, PartitionIndex partition) const
  {
    const Ends& ends = this->EndsOf[std::size_t(piece)];
    return partition >= 0 && (ends.Partition[0] == partition || ends.Partition[1] == partition);
  }

  /// Whether a piece that is not known, or another segment without ends among the points, may cross
  /// interior triangles of the partition. `tree` has the segments; pieceOf(id) is the piece of the
  /// segment with this id, or -1.
  bool mayEnter(const SegmentTree& tree, PartitionIndex partition,
    const std::function<std::int64_t(std::int64_t)>& pieceOf) const;

  /// The index of a crossed triangle among the partition's interior ones, and the index of a piece.
  using Crossing = std::pair<std::size_t, std::int64_t>;

  /// The interior triangles of a partition.
  struct Interior
  {
    /// Boxes of the edges between these and other triangles. Empty if all triangles are interior.
    std::vector<Box2> Border;
    std::vector<Crossing> Crossings; ///< ascending, without repetition
  };
  const Interior& interiorOf(PartitionIndex partition) const
  {
    return this->Interiors.at(partition);
  }
  /// Vertices in the interior of pieces, including pieces that are left for later.
  std::vector<CrossedTriangles::Touch>& touches() { return this->Touches; }
  const std::vector<CrossedTriangles::Touch>& touches() const { return this->Touches; }

private:
  class Editor;

  /// The ends of a piece. Each is written by the thread that has its partition, while others read.
  struct Ends
  {
    std::array<std::atomic<PartitionIndex>, 2> Partition{ -1, -1 };
    std::array<DelaunayKernel::Index, 2> Vertex{};
  };

  /// Whether an end may be a point that is no vertex, since another point coincides with it.
  bool mayEndAtDuplicate(std::int64_t piece) const
  {
    const Ends& ends = this->EndsOf[std::size_t(piece)];
    const ConstraintPiece& ids = this->Pieces[std::size_t(piece)];
    const auto points = PointId(this->Points.size());
    return (ids.A < points && ends.Partition[0] < 0) || (ids.B < points && ends.Partition[1] < 0);
  }
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
