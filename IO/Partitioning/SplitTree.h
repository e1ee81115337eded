// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSplitTree_h
#define tippSplitTree_h

#include "Partition/BoxTiling.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// A quadtree or octree that grows, over a domain. Nodes are numbered as they come, children one
/// after the other.
class VTKTIPPIO_EXPORT SplitTree
{
public:
  SplitTree(int dimension, const Box3& domain);

  /// The tree of a structure, its nodes numbered depth first.
  SplitTree(int dimension, const Box3& domain, const std::string& structure);

  int dimension() const { return this->Dimension; }
  const Box3& domain() const { return this->Boxes[0]; }
  std::size_t size() const { return this->FirstChild.size(); }
  int childCount() const { return this->ChildCount; }

  /// The first of the node's children, or -1.
  std::int32_t firstChild(std::int32_t node) const { return this->FirstChild[at(node)]; }
  bool isLeaf(std::int32_t node) const { return this->firstChild(node) < 0; }
  const Box3& box(std::int32_t node) const { return this->Boxes[at(node)]; }
  /// The longest side of the node's box.
  double length(std::int32_t node) const;

  /// Whether the node may be split: it is not too deep, and doubles can tell its halves apart.
  bool canSplit(std::int32_t node, int maxDepth) const;
  /// Gives a leaf its children. Throws IOError if the tree would be too large.
  void split(std::int32_t leaf);

  /// Which nodes are split: '1' for such a node and then its children's, '0' for a leaf.
  std::string structure() const;
  /// The structure with all splits of both. Throws IOError if one is none.
  static std::string merged(const std::string& a, const std::string& b, int childCount);

  /// The tree cut back: nodes for which keep() says no are leaves. `leaves` gets the node of each
  /// partition.
  BoxTiling tiling(
    const std::function<bool(std::int32_t)>& keep, std::vector<std::int32_t>& leaves) const;

private:
  static std::size_t at(std::int32_t node) { return static_cast<std::size_t>(node); }

  int Dimension;
  int ChildCount;
  std::vector<std::int32_t> FirstChild;
  std::vector<Box3> Boxes;
  std::vector<std::uint8_t> Depths;
};

} // namespace tipp

#endif
