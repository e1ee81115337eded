// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTiling3_h
#define tippTiling3_h

#include "Predicates/Points.h"
#include "Triangulation/Tiling.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The smallest box of points. Without points Min is infinite.
struct PointBounds
{
  PointBounds();
  void include(const Point3& p);
  void include(const PointBounds& other);

  Box3 Box;
};

/// Partitions of space with about equally many points of a sample: a tree of cuts across the
/// longest side of the sample's box. A point on a cut belongs to the upper side.
class Tiling3
{
public:
  /// Cuts space into at most `count` partitions; fewer if the sample has too few distinct points.
  Tiling3(std::vector<Point3> sample, int count);

  PartitionIndex size() const { return this->Count; }
  PartitionIndex locate(const Point3& p) const;

private:
  struct Node
  {
    int Axis = -1; ///< -1: a partition
    double Cut = 0;
    PartitionIndex Partition = 0;
    std::size_t Upper = 0; ///< the lower side's node follows this one
  };

  using Iterator = std::vector<Point3>::iterator;
  void cut(Iterator begin, Iterator end, int count);

  std::vector<Node> Nodes;
  PartitionIndex Count = 0;
};

/// The points of each partition, in the input's order, and their ids.
struct PointBuckets3
{
  std::vector<Point3> Points;
  std::vector<std::int32_t> Ids;
  std::vector<std::size_t> Begins; ///< of each partition, and one past the last
  std::vector<Box3> Regions;       ///< the points' bounding boxes

  std::size_t count(PartitionIndex p) const
  {
    return this->Begins[std::size_t(p) + 1] - this->Begins[std::size_t(p)];
  }
};

/// Sorts finite points by partition. Points that are not finite are left out.
PointBuckets3 bucketPoints(
  const Point3* points, std::size_t count, const Tiling3& tiling, double factor, int threads);

} // namespace tipp

#endif
