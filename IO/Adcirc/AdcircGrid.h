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
/// of the nodes of boundaries. Numbers are written as ListDirectedRows reads them.
struct AdcircGrid
{
  std::string Title;
  std::vector<double> XY;    ///< x and y of the nodes, interleaved, in the order of the file
  std::vector<double> Depth; ///< below the datum, positive downwards
  std::vector<std::int64_t> Triangles; ///< three node indices, from 0, per triangle
  /// The index of each node number; numbers may have gaps and be in any order.
  std::unordered_map<std::int64_t, std::int64_t> IndexOf;
  std::string Boundaries; ///< the lines after the elements, unchanged
  /// Pairs of consecutive boundary nodes, as indices; boundaries of islands are closed.
  std::vector<std::array<std::int64_t, 2>> BoundaryEdges;
};

/// Reads the grid without BoundaryEdges. Throws IOError, also if an element is not a triangle.
VTKTIPPIO_EXPORT AdcircGrid readAdcircGrid(const std::string& path);

///@{
/// Reads the grid without Triangles and, in the first case, without BoundaryEdges. Elements may
/// have three or four corners. Throws IOError.
VTKTIPPIO_EXPORT AdcircGrid readAdcircNodes(const std::string& path);
AdcircGrid readAdcircBoundaries(const std::string& path);
///@}

} // namespace tipp

#endif
