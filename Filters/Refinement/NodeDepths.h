// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNodeDepths_h
#define tippNodeDepths_h

#include "Arrays/Buffer.h"
#include "Meshes/MeshOptions.h"
#include "Points/ReadPoints.h"
#include "Raster/RasterValues.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// What values of a raster or of points are.
enum class VerticalAxis
{
  Depths,    ///< positive downwards, as in a fort.14
  Elevations ///< positive upwards, as in LAS files and terrain models
};

/// How a node gets its depth from a raster.
enum class NodeRule
{
  CellMean, ///< the mean of the pixels in the node's cell
  AtNode    ///< bilinear between the pixels' centres around the node
};

/// The depths of a mesh's nodes, and how many of them come from where.
struct NodeDepths
{
  Buffer<double> Values;      ///< one per node, positive downwards; NaN where there is none
  std::int64_t FromCells = 0; ///< means over the node's cell
  std::int64_t AtNodes =
    0; ///< interpolated at the node: its cell has no pixel, or NodeRule::AtNode
  std::int64_t FromOthers = 0; ///< from neighbouring nodes, because there are no data at the node
  std::int64_t Missing = 0;    ///< NaN: none of the nodes connected with it has a value
};

class PagedMemory;

struct NodeDepthOptions
{
  VerticalAxis Axis = VerticalAxis::Elevations; ///< of the raster's or the points' values
  int Threads = 0;                              ///< 0: defaultThreads()
  /// Where the depths are. With it, the mesh is searched in strips that are small beside its limit,
  /// so that it may be larger than memory. Null: the process's memory, and the whole mesh at once.
  PagedMemory* Memory = nullptr;
  std::size_t Strips = 0; ///< the number of strips; 0: by the limit of Memory
};

// The cell of a node is the part of the mesh's triangles that is nearer to it than to the other
// corners, in barycentric coordinates: the quadrilaterals between the node, the middles of edges
// and the centroids. A pixel counts in the cell that contains its centre; on the line between two
// cells, in that of the node of lower index. Values are added in the order of the input, so that
// results do not depend on threads. Nodes without data get the mean of the neighbours that have a
// value, those next to them first. Triangles' ids must be valid. The nodes' coordinates are those
// of the raster or the points. Results do not depend on strips.
//
// Memory: the mesh or a strip with a structure to locate points, 40 bytes per node of it for sums
// and depths, and some rows of the raster or a block of points: 2^18 at once, or two rows. Both
// functions throw IOError and WorkAborted.

/// Computes depths from a raster. It is read from south to north, only where the mesh is, and once
/// if there is one strip.
VTKTIPPFILTERS_EXPORT NodeDepths depthsFromRaster(const NodesView& nodes, TrianglesView triangles,
  RasterValues& raster, NodeRule rule, const NodeDepthOptions& options);

/// Computes depths as the mean of a column of the points in each node's cell. The stream is read
/// once. Throws IOError also if there is no such column.
VTKTIPPFILTERS_EXPORT NodeDepths depthsFromPoints(const NodesView& nodes, TrianglesView triangles,
  PointStream& points, const std::string& column, const NodeDepthOptions& options);

} // namespace tipp

#endif
