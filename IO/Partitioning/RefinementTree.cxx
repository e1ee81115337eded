// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/BuildTree.h"

#include "Files/IOError.h"

#include <algorithm>

namespace tipp
{
namespace
{

constexpr std::size_t MostNodes = std::size_t(1) << 24;

} // namespace

RefinementTree::RefinementTree(int dimension, const Box3& domain)
  : Dimension(dimension)
  , ChildCount(BoxTiling::childCount(dimension, domain))
  , FirstChild{ -1 }
  , Boxes{ domain }
  , Depths{ 0 }
{
}

double RefinementTree::length(std::int32_t node) const
{
  const Box3& box = this->box(node);
  double longest = 0.0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->Dimension); ++axis)
  {
    longest = std::max(longest, box.Max[axis] - box.Min[axis]);
  }
  return longest;
}

bool RefinementTree::canSplit(std::int32_t node) const
{
  if (this->ChildCount == 1 || this->Depths[at(node)] >= BoxTiling::MaxDepth)
  {
    return false;
  }
  const Box3& box = this->box(node);
  const Box3 lowest = BoxTiling::childBox(this->Dimension, this->domain(), box, 0);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->Dimension); ++axis)
  {
    const bool cut = this->domain().Min[axis] < this->domain().Max[axis];
    const double middle = lowest.Max[axis];
    if (cut && (middle <= box.Min[axis] || middle >= box.Max[axis]))
    {
      return false;
    }
  }
  return true;
}

void RefinementTree::split(std::int32_t leaf)
{
  if (this->size() + static_cast<std::size_t>(this->ChildCount) > MostNodes)
  {
    throw IOError("The tree of partitions would have more than " + std::to_string(MostNodes) +
      " nodes; allow more cells a partition.");
  }
  this->FirstChild[at(leaf)] = static_cast<std::int32_t>(this->size());
  const auto depth = static_cast<std::uint8_t>(this->Depths[at(leaf)] + 1);
  for (int which = 0; which < this->ChildCount; ++which)
  {
    this->Boxes.push_back(
      BoxTiling::childBox(this->Dimension, this->domain(), this->box(leaf), which));
    this->FirstChild.push_back(-1);
    this->Depths.push_back(depth);
  }
}

std::string RefinementTree::structure() const
{
  std::string letters;
  letters.reserve(this->size());
  const auto add = [&](const auto& self, std::int32_t node) -> void
  {
    letters.push_back(this->isLeaf(node) ? '0' : '1');
    for (int which = 0; which < this->ChildCount && !this->isLeaf(node); ++which)
    {
      self(self, this->firstChild(node) + which);
    }
  };
  add(add, 0);
  return letters;
}

void RefinementTree::refine(const std::string& structure)
{
  // Stack of nodes whose letter has not been read, the next one last.
  std::vector<std::int32_t> waiting = { 0 };
  const auto require = [](bool isValid)
  {
    if (!isValid)
    {
      throw IOError("A rank sent nodes that do not make a tree of partitions.");
    }
  };
  for (const char letter : structure)
  {
    require(!waiting.empty() && (letter == '0' || letter == '1'));
    const std::int32_t node = waiting.back();
    waiting.pop_back();
    if (letter == '0')
    {
      continue;
    }
    require(this->Depths[at(node)] < BoxTiling::MaxDepth);
    if (this->isLeaf(node))
    {
      this->split(node);
    }
    for (int which = this->ChildCount - 1; which >= 0; --which)
    {
      waiting.push_back(this->firstChild(node) + which);
    }
  }
  require(waiting.empty());
}

BoxTiling RefinementTree::tiling(const std::function<bool(std::int32_t)>& keep) const
{
  std::vector<std::int32_t> nodes = { -1 };
  const auto add = [&](const auto& self, std::int32_t from, std::size_t to) -> void
  {
    if (this->isLeaf(from) || !keep(from))
    {
      return;
    }
    const std::size_t first = nodes.size();
    nodes[to] = static_cast<std::int32_t>(first);
    nodes.insert(nodes.end(), static_cast<std::size_t>(this->ChildCount), -1);
    for (int which = 0; which < this->ChildCount; ++which)
    {
      self(self, this->firstChild(from) + which, first + static_cast<std::size_t>(which));
    }
  };
  add(add, 0, 0);
  return BoxTiling::tree(this->Dimension, this->domain(), nodes);
}

} // namespace tipp
