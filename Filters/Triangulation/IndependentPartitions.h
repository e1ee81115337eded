// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIndependentPartitions_h
#define tippIndependentPartitions_h

#include "Triangulation/SeamMesh.h"

#include <cstdint>
#include <vector>

namespace tipp
{

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
  /// The partitions that have something to triangulate.
  IndependentPartitions(SeamMesh& mesh, std::vector<PartitionIndex> unfinished);

  /// A maximal set of independent partitions, those with the fewest conflicts first (Algorithm 2).
  std::vector<PartitionIndex> nextStage();

  /// A partition independent of all active ones, or -1. It is active from now on.
  PartitionIndex activateNext();
  void deactivate(PartitionIndex partition);

  bool isEmpty() const { return this->Unfinished.empty(); }

private:
  bool isIndependentOfActive(PartitionIndex partition);
  void activate(PartitionIndex partition);
  std::vector<std::size_t> countConflicts();

  SeamMesh& Mesh;
  std::vector<PartitionIndex> Unfinished; ///< neither active nor finished
  std::vector<char> LabelIsActive;
  std::vector<std::vector<std::uint32_t>> ActiveReach; ///< of each active partition
};

} // namespace tipp

#endif
