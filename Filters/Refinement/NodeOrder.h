// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNodeOrder_h
#define tippNodeOrder_h

#include "Arrays/Buffer.h"
#include "Meshes/MeshOptions.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Returns the reverse Cuthill-McKee order of a mesh's nodes: element i is the present index of the
/// node that becomes node i. Models solve faster if the numbers of neighbours are close together.
/// `nodes` is the number of nodes, which the triangles' ids must be below.
///
/// Each component is traversed breadth first from a pseudo-peripheral node; nodes at the same
/// distance come by their neighbours' order, then by degree, then by index. So the order depends on
/// the mesh alone. Components follow each other by their lowest nodes, before the reversal. Nodes
/// without triangles are components. Throws WorkAborted, and std::length_error for more than 2^31 -
/// 1 nodes.
/// Source: A. George, J. Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981,
/// chapter 4.
VTKTIPPFILTERS_EXPORT std::vector<std::int64_t> reverseCuthillMcKee(
  std::size_t nodes, TrianglesView triangles);

/// The bandwidth of a mesh: the largest difference between the indices of two nodes with a common
/// edge; 0 without triangles.
VTKTIPPFILTERS_EXPORT std::int64_t bandwidthOf(TrianglesView triangles);

/// The bandwidth that the mesh would have in this order.
VTKTIPPFILTERS_EXPORT std::int64_t bandwidthOf(
  TrianglesView triangles, const std::vector<std::int64_t>& order);

/// Reorders the nodes of a mesh: the rows of `points` and the ids in `triangles`, three per
/// triangle. The order of triangles and of their corners is kept.
VTKTIPPFILTERS_EXPORT void applyNodeOrder(
  const std::vector<std::int64_t>& order, PointTable& points, Buffer<std::int32_t>& triangles);

/// Returns the inverse of an order: element i is the new index of node i.
VTKTIPPFILTERS_EXPORT std::vector<std::int64_t> inverseOrder(
  const std::vector<std::int64_t>& order);

} // namespace tipp

#endif
