// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippModelBoundaries_h
#define tippModelBoundaries_h

#include "Adcirc/AdcircBoundaries.h"
#include "Meshes/MeshOptions.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Says which nodes may be on an open boundary, by their indices.
using OpenNodes = std::function<bool(std::int64_t node)>;

/// Returns the nodes inside of a polygon or on its border, decided exactly. Its rings are closed
/// without repeating the first corner; what lies in an even number of rings is outside. The arrays
/// that `nodes` refers to must outlive the result.
VTKTIPPFILTERS_EXPORT OpenNodes nodesInside(
  const NodesView& nodes, std::vector<std::vector<Point2>> rings);

/// Returns the nodes that are deeper than `depth`. `depths`, one per node and positive downwards,
/// must outlive the result. NaN is not deeper.
VTKTIPPFILTERS_EXPORT OpenNodes nodesDeeperThan(const double* depths, double depth);

/// The kinds of boundaries without flow: ADCIRC's IBTYPE. SCHISM has 0 and 1 instead.
struct LandKinds
{
  std::int64_t Mainland = 20;
  std::int64_t Island = 21;
};

/// The boundaries of a mesh, for a model.
struct ModelBoundaries
{
  AdcircBoundaries Lists;
  std::int64_t OuterLoops = 0; ///< outer borders: one per part of the mesh
  std::int64_t Islands = 0;
  /// Nodes at which the border touches itself. ADCIRC and SCHISM do not run with such a node.
  std::int64_t TouchingNodes = 0;
  /// Nodes that `isOpen` chose, but no neighbour on the border. They are mainland, since an open
  /// boundary has at least one edge.
  std::int64_t LoneOpenNodes = 0;
};

/// Finds the boundaries of a mesh of triangles. Outer borders are mainland, except for runs of at
/// least two nodes that `isOpen` chooses, which are open boundaries. An open boundary and the
/// mainland beside it share the node between them. If `isOpen` chooses all nodes of an outer
/// border, it is one open boundary, whose first node is not repeated. Borders of holes are islands.
/// Loops start at their lowest node, open boundaries of a loop follow each other from the one that
/// has or follows this node, and loops are sorted by their lowest nodes.
///
/// The triangles' ids must be valid, and an edge may have at most two triangles. `segments`: pairs
/// of nodes, among them all edges of the border. With them, only triangles at their ends are held
/// in memory, so that the mesh may be larger; empty: unknown. Throws WorkAborted.
VTKTIPPFILTERS_EXPORT ModelBoundaries findModelBoundaries(const NodesView& nodes,
  TrianglesView triangles, const OpenNodes& isOpen, const LandKinds& kinds = {},
  const std::vector<std::array<std::int64_t, 2>>& segments = {});

} // namespace tipp

#endif
