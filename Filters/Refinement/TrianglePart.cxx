// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/TrianglePart.h"

#include "Files/MemoryLimits.h"

#include <memory>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// A set of node ids that gives each its index in ascending order: one bit per node of the mesh,
/// and a count every 64 nodes.
class NodeNumbering
{
public:
  explicit NodeNumbering(std::size_t nodes)
    : Bits(nodes / 64 + 1, 0)
    , Before(nodes / 64 + 1, 0)
  {
  }

  void add(std::int64_t id)
  {
    this->Bits[std::size_t(id) / 64] |= std::uint64_t(1) << (std::size_t(id) % 64);
  }
  /// Call this once all ids are added.
  void count()
  {
    for (std::size_t i = 0; i < this->Bits.size(); ++i)
    {
      this->Before[i] = this->Size;
      this->Size += std::int32_t(__builtin_popcountll(this->Bits[i]));
    }
  }

  std::size_t size() const { return std::size_t(this->Size); }
  std::int32_t indexOf(std::int64_t id) const
  {
    const std::uint64_t below = (std::uint64_t(1) << (std::size_t(id) % 64)) - 1;
    const std::size_t word = std::size_t(id) / 64;
    return this->Before[word] + std::int32_t(__builtin_popcountll(this->Bits[word] & below));
  }
  /// Calls visit(id) for all ids, ascending.
  template <typename Visit>
  void forIds(const Visit& visit) const
  {
    for (std::size_t word = 0; word < this->Bits.size(); ++word)
    {
      for (std::uint64_t bits = this->Bits[word]; bits != 0; bits &= bits - 1)
      {
        visit(std::int64_t(64 * word) + __builtin_ctzll(bits));
      }
    }
  }

private:
  std::vector<std::uint64_t> Bits;
  std::vector<std::int32_t> Before; ///< by word: the number of ids before it
  std::int32_t Size = 0;
};

/// The memory of a part.
struct PartArrays
{
  std::vector<double> XYZ;
  std::vector<std::int32_t> Ids;
  std::vector<std::int64_t> PointIds;
  std::vector<std::uint8_t> Ghosts;
};

/// Keeps the limits of memory in a loop, about each megabyte.
void keepLimitsAt(std::size_t i)
{
  if (i % (1 << 16) == 0)
  {
    keepMemoryLimits();
  }
}

} // namespace

MeshPart partOfTriangles(const NodesView& nodes, TrianglesView triangles)
{
  auto xyz = std::make_shared<std::vector<double>>(3 * nodes.size(), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    (*xyz)[3 * i] = nodes[i].x;
    (*xyz)[3 * i + 1] = nodes[i].y;
  }
  MeshPart part;
  part.Mesh.Points = xyz->data();
  part.Mesh.PointCount = std::int64_t(nodes.size());
  part.Mesh.Cells = std::int64_t(triangles.size());
  triangles.withIds(
    [&part](const auto* ids)
    {
      part.Mesh.Ids = ids;
      part.Mesh.Wide = sizeof(*ids) == sizeof(std::int64_t);
    });
  part.OwnedCells = part.Mesh.Cells;
  part.Keeps = std::move(xyz);
  return part;
}

MeshPart partOfTriangles(const NodesView& nodes, TrianglesView triangles,
  const std::int32_t* chosen, std::size_t count,
  const std::function<bool(std::int64_t node)>& isOwned)
{
  NodeNumbering numbers(nodes.size());
  const auto forCorners = [&](const auto& visit)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      keepLimitsAt(i);
      for (int corner = 0; corner < 3; ++corner)
      {
        visit(triangles.id(std::size_t(chosen[i]), corner));
      }
    }
  };
  forCorners([&numbers](std::int64_t id) { numbers.add(id); });
  numbers.count();
  auto arrays = std::make_shared<PartArrays>();
  arrays->Ids.reserve(3 * count);
  forCorners([&](std::int64_t id) { arrays->Ids.push_back(numbers.indexOf(id)); });
  arrays->XYZ.reserve(3 * numbers.size());
  arrays->PointIds.reserve(numbers.size());
  arrays->Ghosts.reserve(numbers.size());
  numbers.forIds(
    [&](std::int64_t id)
    {
      keepLimitsAt(arrays->PointIds.size());
      const Point2 p = nodes[std::size_t(id)];
      arrays->XYZ.insert(arrays->XYZ.end(), { p.x, p.y, 0 });
      arrays->PointIds.push_back(id);
      arrays->Ghosts.push_back(isOwned(id) ? 0 : 1);
    });
  MeshPart part;
  part.Mesh.Points = arrays->XYZ.data();
  part.Mesh.PointCount = std::int64_t(numbers.size());
  part.Mesh.Ids = arrays->Ids.data();
  part.Mesh.Cells = std::int64_t(count);
  part.OwnedCells = part.Mesh.Cells;
  part.PointIds = arrays->PointIds.data();
  part.Ghosts = arrays->Ghosts.data();
  part.Keeps = std::move(arrays);
  return part;
}

} // namespace tipp
