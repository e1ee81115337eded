// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIndependentPartitions_h
#define tippIndependentPartitions_h

#include "Triangulation/SeamTriangles.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// What independence is decided on.
class ReachSource
{
public:
  virtual ~ReachSource() = default;

  /// The labels of the vertices of the partition's triangles, each once; and perhaps of some that
  /// were superseded since triangles were last added to it.
  virtual const std::vector<std::uint32_t>& reach(PartitionIndex partition) = 0;

  virtual PartitionIndex partitions() const = 0;
  std::size_t labelEnd() const { return 4 * static_cast<std::size_t>(this->partitions()); }
};

/// The same for a mesh that does not change.
class VTKTIPPFILTERS_EXPORT MeshReach : public ReachSource
{
public:
  MeshReach(PartitionIndex partitions, const SeamTriangles& mesh);

  const std::vector<std::uint32_t>& reach(PartitionIndex partition) override
  {
    return this->Labels[std::size_t(partition)];
  }
  PartitionIndex partitions() const override
  {
    return static_cast<PartitionIndex>(this->Labels.size());
  }

private:
  std::vector<std::vector<std::uint32_t>> Labels;
};

/// Which partitions may be active together.
///
/// Algorithm 2 lets two partitions be active if no circumdisk meets both. That is not enough: with
/// an edge whose two triangles belong one to each, an empty disk through the edge's ends can meet
/// both partitions, and a new edge from one to the other would be found by neither worker. An
/// empty disk lies in the union of the circumdisks of two triangles with a common edge, so
/// partitions are independent if no edge of the mesh has a triangle of each. Here: if the vertices
/// of their triangles share no label, which implies it.
class IndependentPartitions
{
public:
  /// The partitions that have something to triangulate. Homes: of each partition of the mesh, the
  /// workers who alone may have it; none: all may have all.
  IndependentPartitions(ReachSource& mesh, const std::vector<PartitionIndex>& unfinished,
    const std::vector<std::int32_t>& homes = {});

  /// A maximal set of independent partitions, those with the fewest conflicts first (Algorithm 2).
  std::vector<PartitionIndex> nextStage();

  /// A partition independent of all active ones, or -1. It is active from now on.
  PartitionIndex activateNext(std::int32_t home = 0);
  void deactivate(PartitionIndex partition);

  bool isEmpty() const { return this->Left == 0; }

private:
  bool isIndependentOfActive(PartitionIndex partition);
  void activate(PartitionIndex partition);
  std::vector<std::size_t> countConflicts(const std::vector<PartitionIndex>& partitions);

  ReachSource& Mesh;
  std::vector<std::vector<PartitionIndex>> Unfinished; ///< neither active nor finished, by home
  std::size_t Left;                                    ///< of them all
  std::vector<char> LabelIsActive;
  std::vector<std::vector<std::uint32_t>> ActiveReach; ///< of each active partition
};

} // namespace tipp

#endif
