// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTilingChoice_h
#define tippTilingChoice_h

#include "vtkTIPPIOModule.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace tipp
{

/// How the domain is split into partitions.
struct TilingChoice
{
  /// The boxes along each axis of a regular grid.
  std::array<int, 3> Boxes{ 4, 4, 1 };
  /// If not 0: a quadtree or octree; a node that more cells meet is split, down to
  /// BoxTiling::MaxDepth. Only cells no longer than the node count.
  std::int64_t Threshold = 0;

  /// Parses "grid:4x4", "grid:4x4x2", "quadtree:100000" or "octree:100000"; nullopt for any other
  /// text.
  VTKTIPPIO_EXPORT static std::optional<TilingChoice> parse(const std::string& text);
  VTKTIPPIO_EXPORT std::string text(int dimension) const;
};

} // namespace tipp

#endif
