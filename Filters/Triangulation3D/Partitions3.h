// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitions3_h
#define tippPartitions3_h

#include "Predicates/Geometry.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/CutTree.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Regions.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Groups of partitions, such as those of the ranks of a run.
struct PartitionGroups
{
  int Count = 1;
  int Each = 1; ///< partitions per group
  /// By which fraction of all points the first group has fewer points than each other group.
  double FirstLess = 0;
  /// Whether the cuts between groups (AreSlabs), or those between the partitions of a group, are
  /// all across one axis: the longest side of the sample's bounding box.
  bool AreSlabs = false;
  bool ArePartitionsSlabs = false;
};

/// Divides space into partitions with about equal numbers of sample points: a tree of cuts, each
/// across the longest side of its sample points' bounding box.
class VTKTIPPFILTERS_EXPORT Tiling3 : public CutTree<3>
{
public:
  /// Cuts space into at most `count` partitions; fewer if the sample has too few distinct points.
  Tiling3(std::vector<Point3> sample, int count);

  /// Does the same for groups of partitions. A point's group does not depend on the number of
  /// partitions per group.
  Tiling3(std::vector<Point3> sample, const PartitionGroups& groups);

  /// Saves or restores a tiling; its groups are not saved.
  template <typename Archive>
  friend void serialize(Archive& archive, Tiling3& tiling)
  {
    archive(tiling.Nodes, tiling.Firsts, tiling.Count);
  }

  /// Returns the group of a partition. Groups ascend with the partitions.
  int groupOf(PartitionIndex p) const { return this->Firsts[std::size_t(p)] / this->Groups.Each; }

  /// Returns the closed boxes of all partitions. Together they fill `domain`.
  std::vector<Box3> boxes(const Box3& domain) const;

private:
  using Iterator = std::vector<Point3>::iterator;
  std::int32_t cut(Iterator begin, Iterator end, int first, int count);
  int axisFor(int count, const Box3& box);
  double shareBefore(int partition) const;
  void setBoxes(const Node& node, const Box3& box, std::vector<Box3>& boxes) const;

  PartitionGroups Groups;
  int SlabAxis = -1;
  std::vector<int> Firsts; ///< by partition: its number if all requested partitions had been made
};

/// The points of a partition.
struct PartitionPoints3
{
  PartitionIndex Partition = -1;
  const Point3* Points = nullptr;
  std::size_t Count = 0;
  const std::int32_t* Ids = nullptr; ///< indices of the points, less First; null: consecutive
  /// The id of the first point of the rank or input.
  std::int64_t First = 0;

  std::int64_t id(std::size_t i) const
  {
    return this->First + (this->Ids ? this->Ids[i] : std::int64_t(i));
  }
};

/// The points of each partition, in the input's order, and their indices in the input.
struct PointBuckets3
{
  std::vector<Point3> Points;
  std::vector<std::int32_t> Ids;
  std::vector<std::size_t> Begins; ///< by partition: its first point; one more entry at the end
  std::vector<Box3> Regions;       ///< by partition: its points' bounding box

  std::size_t count(PartitionIndex p) const
  {
    return this->Begins[std::size_t(p) + 1] - this->Begins[std::size_t(p)];
  }
  /// Returns for each partition 1 if it has points, else 0.
  std::vector<char> areUsed() const
  {
    std::vector<char> areUsed;
    for (std::size_t p = 0; p < this->Regions.size(); ++p)
    {
      areUsed.push_back(this->count(PartitionIndex(p)) > 0 ? 1 : 0);
    }
    return areUsed;
  }
  /// Returns the regions of the partitions of `tiling`, which must outlive them.
  RegionsOf<3> regions(const Tiling3& tiling) const
  {
    return { tiling, this->Regions, this->areUsed() };
  }
  /// Returns the points of a partition. `first` is added to their ids.
  PartitionPoints3 of(PartitionIndex p, std::int64_t first = 0) const
  {
    const std::size_t begin = this->Begins[std::size_t(p)];
    return { p, this->Points.data() + begin, this->count(p), this->Ids.data() + begin, first };
  }
};

/// Sorts the finite points by partition. Leaves out points that are not finite.
PointBuckets3 bucketPoints(const PointsView3& points, const Tiling3& tiling, int threads);

/// Returns the indices of about `wanted` points, ascending: the first points with the smallest and
/// largest coordinates, and others at equal steps in the input's order.
std::vector<std::size_t> chooseInitialPoints(
  const Point3* points, std::size_t count, std::size_t wanted);

/// Returns artificial points on the sides of a box around the domain, its corners among them. Their
/// distance from the domain and from each other is about the width of a partition: its longest side
/// or, for slabs, half of its shortest one. Returns an empty list if doubles cannot enclose the
/// domain.
std::vector<Vertex3> makeArtificialPoints(const PointBuckets3& buckets, bool areSlabs = false);

/// The number of points of each partition in the initial mesh.
constexpr std::size_t InitialPointsOfPartition3 = 48;

/// Returns the initial mesh: the Delaunay triangulation of some points of each partition and of the
/// artificial points. The proof of Lemma 5 in PartitionSchedule.h holds with 'facet' for 'edge'.
/// `wanted`: about how many initial points a partition gets.
BoundaryCells<3> makeInitialMesh(const Tiling3& tiling, const PointBuckets3& buckets,
  const std::vector<Vertex3>& artificial, std::size_t wanted = InitialPointsOfPartition3);

} // namespace tipp

#endif
