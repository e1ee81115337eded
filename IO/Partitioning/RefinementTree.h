// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRefinementTree_h
#define tippRefinementTree_h

#include "Partition/BoxTiling.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// A growing quadtree or octree over a domain. Nodes are numbered in the order of creation,
/// siblings consecutively.
class VTKTIPPIO_EXPORT RefinementTree
{
public:
  RefinementTree(int dimension, const Box3& domain);

  /// Builds the tree of a structure, its nodes numbered depth first.
  RefinementTree(int dimension, const Box3& domain, const std::string& structure);

  int dimension() const { return this->Dimension; }
  const Box3& domain() const { return this->Boxes[0]; }
  std::size_t size() const { return this->FirstChild.size(); }
  int childCount() const { return this->ChildCount; }

  /// The index of the node's first child, or -1.
  std::int32_t firstChild(std::int32_t node) const { return this->FirstChild[at(node)]; }
  bool isLeaf(std::int32_t node) const { return this->firstChild(node) < 0; }
  const Box3& box(std::int32_t node) const { return this->Boxes[at(node)]; }
  /// The longest side of the node's box.
  double length(std::int32_t node) const;

  /// Whether the node may be split: its depth is less than maxDepth, and its halves differ in
  /// doubles.
  bool canSplit(std::int32_t node, int maxDepth) const;
  /// Adds a leaf's children. Throws IOError if the tree would be too large.
  void split(std::int32_t leaf);

  /// The tree in depth-first order: '1' for a split node, followed by its children, '0' for a leaf.
  std::string structure() const;
  /// Returns the union of two structures. Throws IOError if one is invalid.
  static std::string merged(const std::string& a, const std::string& b, int childCount);

  /// Returns the tiling of the tree in which nodes for which keep() returns false are leaves.
  /// `leaves` receives the node of each partition.
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
