// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTiling3_h
#define tippTiling3_h

#include "Predicates/Points.h"
#include "Triangulation/Tiling.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

inline bool isFinite(const Point3& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// The smallest box of points. Without points Min is infinite.
struct PointBounds
{
  PointBounds();
  void include(const Point3& p);
  void include(const PointBounds& other);

  Box3 Box;
};

/// What a first pass over points finds.
struct PointSurvey3
{
  std::vector<std::int64_t> Rejected; ///< indices of those that are not finite; ascending
  double Largest = 0;                 ///< magnitude of a coordinate of the finite ones
};
PointSurvey3 surveyPoints(const Point3* points, std::size_t count);

/// A power of two that brings coordinates near 1 where the largest magnitude is very small or very
/// large, so that the filters of predicates work; else 1.
double moderateFactor(double largest);
/// Whether multiplying by the factor is exact for a coordinate.
inline bool isExactTimes(double x, double factor)
{
  return !std::isfinite(x) || x * factor / factor == x;
}
bool areExactTimes(const Point3* points, std::size_t count, double factor);

/// Groups of partitions, as of the ranks of a run.
struct PartitionGroups
{
  int Count = 1;
  int Each = 1; ///< partitions of a group
  /// By how much less the first group has than the others: a fraction of all points.
  double FirstLess = 0;
  /// Whether the cuts between groups, or all cuts, are parallel: across the longest side of the
  /// sample's box.
  bool AreSlabs = false;
  bool ArePartitionsSlabs = false;
};

/// Partitions of space with about equally many points of a sample: a tree of cuts across the
/// longest side of the sample's box. A point on a cut belongs to the upper side.
class Tiling3
{
public:
  /// Cuts space into at most `count` partitions; fewer if the sample has too few distinct points.
  Tiling3(std::vector<Point3> sample, int count);

  /// The same for groups. Which group has a point does not depend on how many partitions each has.
  Tiling3(std::vector<Point3> sample, const PartitionGroups& groups);

  PartitionIndex size() const { return this->Count; }
  /// The group of a partition; ascending.
  int groupOf(PartitionIndex p) const { return this->Firsts[std::size_t(p)] / this->Groups.Each; }
  PartitionIndex locate(const Point3& p) const;

  /// The closed boxes of all partitions, which fill `domain`.
  std::vector<Box3> boxes(const Box3& domain) const;

  /// Calls visit(partition) for those whose closed boxes may meet the box; those of the lower side
  /// of a cut come first.
  template <typename Visit>
  void visitMet(const Box3& box, const Visit& visit) const
  {
    this->visitMet(0, box, visit);
  }

private:
  struct Node
  {
    int Axis = -1; ///< -1: a partition
    double Cut = 0;
    PartitionIndex Partition = 0;
    std::size_t Upper = 0; ///< the lower side's node follows this one
  };

  using Iterator = std::vector<Point3>::iterator;
  void cut(Iterator begin, Iterator end, int first, int count);
  int axisFor(int count, const Box3& box);
  double shareBefore(int partition) const;
  void setBoxes(std::size_t node, const Box3& box, std::vector<Box3>& boxes) const;

  template <typename Visit>
  void visitMet(std::size_t at, const Box3& box, const Visit& visit) const
  {
    const Node& node = this->Nodes[at];
    if (node.Axis < 0)
    {
      visit(node.Partition);
      return;
    }
    if (box.Min[std::size_t(node.Axis)] <= node.Cut)
    {
      this->visitMet(at + 1, box, visit);
    }
    if (box.Max[std::size_t(node.Axis)] >= node.Cut)
    {
      this->visitMet(node.Upper, box, visit);
    }
  }

  PartitionGroups Groups;
  int SlabAxis = -1;
  std::vector<Node> Nodes;
  std::vector<int> Firsts; ///< by partition: its number, of all that are asked for
  PartitionIndex Count = 0;
};

/// The points of a partition.
struct PartitionPoints3
{
  PartitionIndex Partition = -1;
  const Point3* Points = nullptr;
  std::size_t Count = 0;
  const std::int32_t* Ids = nullptr; ///< counted from First; null: consecutive
  std::int64_t First = 0;

  std::int64_t id(std::size_t i) const
  {
    return this->First + (this->Ids ? this->Ids[i] : std::int64_t(i));
  }
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
  /// Ids are counted from `first`.
  PartitionPoints3 of(PartitionIndex p, std::int64_t first = 0) const
  {
    const std::size_t begin = this->Begins[std::size_t(p)];
    return { p, this->Points.data() + begin, this->count(p), this->Ids.data() + begin, first };
  }
};

/// Sorts finite points by partition. Points that are not finite are left out.
PointBuckets3 bucketPoints(
  const Point3* points, std::size_t count, const Tiling3& tiling, double factor, int threads);

} // namespace tipp

#endif
