// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAdcircGrid_h
#define tippAdcircGrid_h

#include "vtkTIPPIOModule.h"

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// Nodes and triangles of an ADCIRC grid (fort.14, https://adcirc.org): a title; the numbers of
/// elements and nodes; a line `id x y depth` per node; a line `id 3 a b c` per element; and lists
/// of the nodes of boundaries.
struct AdcircGrid
{
  std::vector<double> XY;              ///< of the nodes, in the order of the file
  std::vector<double> Depth;           ///< below the datum, positive downwards
  std::vector<std::int64_t> Triangles; ///< three node indices, from 0, per triangle
  /// The index of each node number; numbers may have gaps and be in any order.
  std::unordered_map<std::int64_t, std::int64_t> IndexOf;
  /// Pairs of consecutive boundary nodes, as indices; boundaries of islands are closed.
  std::vector<std::array<std::int64_t, 2>> BoundaryEdges;
};

/// What a grid has besides nodes and elements.
struct AdcircFrame
{
  std::string Title;
  std::vector<std::int64_t> NodeNumbers; ///< in the order of the file
  std::string Boundaries;                ///< the lines behind the elements, as they are
};

/// Throws IOError.
AdcircFrame readAdcircFrame(const std::string& path);

/// Without the boundaries. Throws IOError.
VTKTIPPIO_EXPORT AdcircGrid readAdcircGrid(const std::string& path);

/// Reads the whole grid. Throws IOError.
AdcircGrid readAdcircGridAndBoundaries(const std::string& path);

} // namespace tipp

#endif
