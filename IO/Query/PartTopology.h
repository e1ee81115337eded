// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartTopology_h
#define tippPartTopology_h

#include "Partitioned/PieceFile.h"
#include "Query/MeshPart.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// The cells at each point of a part, and a map from global ids to local indices. Hidden cells are
/// left out.
///
/// At a point that the piece owns, these are all cells of the whole mesh: they all meet the piece's
/// box.
class PartTopology
{
public:
  explicit PartTopology(const MeshPart& part);

  /// Local indices of the cells with a given point as a corner, ascending.
  struct Cells
  {
    const std::int32_t* First;
    const std::int32_t* Last;
    const std::int32_t* begin() const { return this->First; }
    const std::int32_t* end() const { return this->Last; }
    bool empty() const { return this->First == this->Last; }
  };
  Cells cellsAt(std::int64_t point) const
  {
    const auto at = std::size_t(point);
    return { this->AtPoints.data() + this->Starts[at],
      this->AtPoints.data() + this->Starts[at + 1] };
  }

  /// Prefetches the cells at points (local indices), which are accessed at random.
  [[gnu::always_inline]] void prefetch(const std::int64_t* points, std::int64_t count) const
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      __builtin_prefetch(this->Starts.data() + points[i]);
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      __builtin_prefetch(this->AtPoints.data() + this->Starts[std::size_t(points[i])]);
    }
    const std::size_t bytes = std::size_t(this->Corners) * (this->Wide ? 8 : 4);
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (const std::int32_t cell : this->cellsAt(points[i]))
      {
        __builtin_prefetch(static_cast<const char*>(this->Ids) + std::size_t(cell) * bytes);
      }
    }
  }

  /// The local index of a global id, or -1 if the part does not have it.
  std::int64_t findPoint(std::int64_t id) const { return find(this->PointMap, id, this->Points); }
  std::int64_t findCell(std::int64_t id) const { return find(this->CellMap, id, this->AllCells); }

  /// Corner i of a cell, as the local index of a point.
  std::int64_t corner(std::int64_t cell, int i) const
  {
    const std::int64_t index = cell * this->Corners + i;
    return this->Wide ? static_cast<const std::int64_t*>(this->Ids)[index]
                      : static_cast<const std::int32_t*>(this->Ids)[index];
  }
  int corners() const { return this->Corners; }

  /// Calls visit(index) for each cell, except `cell`, that has all points of the face opposite to
  /// the cell's corner `face`, in ascending order. Local indices.
  template <typename Visit>
  void visitAcross(std::int64_t cell, int face, const Visit& visit) const
  {
    std::int64_t corners[3];
    int count = 0;
    for (int i = 0; i < this->Corners; ++i)
    {
      i != face ? void(corners[count++] = this->corner(cell, i)) : void();
    }
    for (const std::int32_t other : this->cellsAt(corners[0]))
    {
      if (other != cell && this->hasCorners(other, corners, count))
      {
        visit(other);
      }
    }
  }

  bool hasCorners(std::int64_t cell, const std::int64_t* corners, int count) const
  {
    int found = 0;
    for (int k = 0; k < count; ++k)
    {
      for (int i = 0; i < this->Corners; ++i)
      {
        found += this->corner(cell, i) == corners[k] ? 1 : 0;
      }
    }
    return found >= count;
  }

  static std::uint64_t bytesFor(std::uint64_t points, std::uint64_t cells, int corners)
  {
    return points * (8 + 12) + cells * (4 * std::uint64_t(corners) + 12);
  }

private:
  static std::int64_t find(
    const std::optional<GlobalIdMap>& map, std::int64_t id, std::int64_t count)
  {
    return map ? map->find(id) : id >= 0 && id < count ? id : -1;
  }

  const void* Ids;
  bool Wide;
  int Corners;
  std::int64_t Points;
  std::int64_t AllCells;
  std::vector<std::int64_t> Starts;
  std::vector<std::int32_t> AtPoints;
  std::optional<GlobalIdMap> PointMap; ///< none: global ids are local indices
  std::optional<GlobalIdMap> CellMap;
};

} // namespace tipp

#endif
