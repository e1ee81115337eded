// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionConstraints_h
#define tippPartitionConstraints_h

#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/CrossedTriangles.h"
#include "Constraints/Insertion/PartitionSegments.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/PointsView.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace tipp
{

/// Inserts segments of constraints while the points are triangulated. A segment is inserted into a
/// partition's mesh if the partition has both ends and all triangles that the segment crosses are
/// interior. At this time the mesh is in the processor's cache and has neighbour relations.
/// Interior triangles are final, and partitions have no common triangles, so the result is the same
/// as if the segments were inserted at the end. Other segments are left for later, and the interior
/// triangles that they cross are recorded. If two segments cross, an editor or a job of
/// retriangulateJobs() finds that one blocks the other, and throws CrossingFound.
class PartitionConstraints : public PartitionEditors
{
public:
  /// `segments` must outlive this object. `others` are the positions of ends that are not among the
  /// points (EndPositions).
  PartitionConstraints(
    const std::vector<IdSegment>& segments, int threads, std::vector<Point2> others = {});

  void begin(PointsView points, const Tiling& tiling) override;
  std::unique_ptr<PartitionEditor> makeEditor() override;

  /// The indices of the segments that are left for later, ascending.
  std::vector<std::int64_t> remaining() const;

  /// All crossings of a partition's interior triangles with segments that are left for later:
  /// ascending, without repetition. Triangles are indices among the partition's interior ones;
  /// partitions are numbered as in begin().
  const std::vector<CrossedTriangles::Crossing>& crossingsIn(PartitionIndex partition) const
  {
    return this->Crossings[std::size_t(partition)];
  }
  /// Vertices in the interior of segments, including segments that are left for later.
  const std::vector<CrossedTriangles::Touch>& touches() const { return this->Touches; }

  /// Edges of the crossed interior triangles that are parts of inserted segments, perhaps repeated.
  using Edge = std::array<PointId, 2>;
  const std::vector<Edge>& fixedEdges() const { return this->FixedEdges; }

  /// Replaces the ids of points in touches() and fixedEdges() by newId(id).
  template <typename NewId>
  void rename(const NewId& newId)
  {
    for (CrossedTriangles::Touch& touch : this->Touches)
    {
      touch.Vertex = newId(touch.Vertex);
    }
    for (Edge& edge : this->FixedEdges)
    {
      edge = { newId(edge[0]), newId(edge[1]) };
    }
  }

private:
  class Editor;

  const std::vector<IdSegment>& Segments;
  const int Threads;
  EndPositions EndsAt; ///< from begin() on in the kernels' coordinates
  PartitionSegments Near;
  std::vector<char> Done;
  std::mutex Mutex;
  std::vector<CrossedTriangles::Touch> Touches;
  std::vector<Edge> FixedEdges;
  std::vector<std::vector<CrossedTriangles::Crossing>> Crossings; ///< by partition
};

} // namespace tipp

#endif
