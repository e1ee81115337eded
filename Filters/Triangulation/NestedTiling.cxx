// Nested tilings, and the serialisation of tilings.
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace tipp
{

/// Adds a box whose partition index is not the next one. Returns its node.
std::int32_t Tiling::placeBox(const Box2& box, PartitionIndex partition, std::size_t depth)
{
  const std::int32_t place = static_cast<std::int32_t>(this->Nodes.size());
  this->Nodes.push_back({ 0, 0, { place, place }, partition });
  this->Boxes.resize(std::max(this->Boxes.size(), std::size_t(partition) + 1));
  this->Boxes[std::size_t(partition)] = box;
  this->Depth = std::max(this->Depth, depth);
  return place;
}

/// Copies another tiling's cuts below the node `from`; makeBox(partition, depth) replaces its
/// boxes. Returns the copied root.
template <typename MakeBox>
std::int32_t Tiling::addTree(
  const Tiling& tree, std::int32_t from, std::size_t depth, const MakeBox& makeBox)
{
  const Node& node = tree.node(from);
  if (node.isBox())
  {
    return makeBox(node.Partition, depth);
  }
  const std::int32_t place = this->addCut(node.Axis, node.At);
  const std::int32_t first = this->addTree(tree, node.Child[0], depth + 1, makeBox);
  const std::int32_t second = this->addTree(tree, node.Child[1], depth + 1, makeBox);
  Node& cut = this->Nodes[std::size_t(place)];
  cut.Child[0] = first;
  cut.Child[1] = second;
  return place;
}

Tiling Tiling::refined(const std::vector<Tiling>& inner) const
{
  Tiling tiling;
  tiling.Domain = this->Domain;
  std::vector<PartitionIndex> firsts = { 0 };
  for (const Tiling& part : inner)
  {
    firsts.push_back(firsts.back() + part.size());
  }
  tiling.addTree(*this, 0, 0,
    [&](PartitionIndex outer, std::size_t depth)
    {
      const Tiling& part = inner[std::size_t(outer)];
      return tiling.addTree(part, 0, depth,
        [&](PartitionIndex p, std::size_t d)
        { return tiling.placeBox(part.box(p), firsts[std::size_t(outer)] + p, d); });
    });
  return tiling;
}

std::vector<char> Tiling::save() const
{
  const std::uint64_t sizes[3] = { this->Depth, this->Nodes.size(), this->Boxes.size() };
  std::vector<char> bytes;
  const auto put = [&bytes](const void* data, std::size_t size)
  {
    const char* begin = static_cast<const char*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
  };
  put(&this->Domain, sizeof(Box2));
  put(sizes, sizeof(sizes));
  put(this->Nodes.data(), this->Nodes.size() * sizeof(Node));
  put(this->Boxes.data(), this->Boxes.size() * sizeof(Box2));
  return bytes;
}

Tiling Tiling::load(const std::vector<char>& bytes)
{
  std::uint64_t sizes[3];
  Tiling tiling;
  std::size_t at = 0;
  const auto get = [&](void* data, std::size_t size)
  {
    if (size > bytes.size() - at)
    {
      throw std::runtime_error("A tiling from another rank is damaged: it ends early.");
    }
    if (size > 0)
    {
      std::memcpy(data, bytes.data() + at, size);
    }
    at += size;
  };
  get(&tiling.Domain, sizeof(Box2));
  get(sizes, sizeof(sizes));
  if (sizes[1] > bytes.size() / sizeof(Node) || sizes[2] > bytes.size() / sizeof(Box2))
  {
    throw std::runtime_error("A tiling from another rank is damaged: its counts are too large.");
  }
  tiling.Depth = sizes[0];
  tiling.Nodes.resize(sizes[1]);
  tiling.Boxes.resize(sizes[2]);
  get(tiling.Nodes.data(), sizes[1] * sizeof(Node));
  get(tiling.Boxes.data(), sizes[2] * sizeof(Box2));
  return tiling;
}

} // namespace tipp
