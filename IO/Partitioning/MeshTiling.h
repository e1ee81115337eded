// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshTiling_h
#define tippMeshTiling_h

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "Partition/BoxTiling.h"
#include "Partitioned/PartitionedMesh.h"
#include "Predicates/Points.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// How the domain is split into partitions.
struct TilingChoice
{
  /// The boxes along each axis of a regular grid.
  std::array<int, 3> Boxes{ 4, 4, 1 };
  /// If not 0: a quadtree or octree whose nodes with more than this number of cells are split, down
  /// to BoxTiling::MaxDepth. Cells longer than the node are not counted.
  std::int64_t Threshold = 0;

  /// Parses "grid:4x4", "grid:4x4x2", "quadtree:100000" or "octree:100000"; nullopt for any other
  /// text.
  VTKTIPPIO_EXPORT static std::optional<TilingChoice> parse(const std::string& text);
  /// The same; throws IOError for any other text.
  VTKTIPPIO_EXPORT static TilingChoice require(const std::string& text);
  /// The inverse of parse(), for a mesh of this dimension.
  VTKTIPPIO_EXPORT std::string text(int dimension) const;
};

template <typename Value>
void takeCoordinatesAs(
  const char* raw, std::size_t count, int components, int dimension, double* to)
{
  Value tuple[3] = {};
  for (std::size_t i = 0; i < count; ++i)
  {
    std::memcpy(tuple, raw, std::size_t(components) * sizeof(Value));
    raw += std::size_t(components) * sizeof(Value);
    for (int axis = 0; axis < dimension; ++axis)
    {
      *to++ = double(tuple[axis]);
    }
  }
}

/// Converts points from the file's layout to `dimension` doubles each; missing coordinates become
/// 0.
inline void takeCoordinates(
  const RawArray& points, const char* raw, std::size_t count, int dimension, double* to)
{
  const int components = std::min(points.Components, 3);
  if (points.Type == Scalar::Float32)
  {
    takeCoordinatesAs<float>(raw, count, components, dimension, to);
  }
  else
  {
    takeCoordinatesAs<double>(raw, count, components, dimension, to);
  }
}

/// Loads the coordinates of the points with these ids: two each for triangles, three for
/// tetrahedra. Throws IOError.
std::vector<double> loadCoordinates(
  const FlatMesh& mesh, VertexLoader& loader, const std::vector<std::int64_t>& ids);

/// Returns the bounding box of all points in the cells' dimension; for triangles z is 0. Throws
/// IOError naming the first point with a coordinate that is not finite. Collective.
Box3 boundsOfPoints(const FlatMesh& mesh, Communicator& ranks, int threads);

/// Writes each point's owner, the first partition whose closed box contains it, to a file of 4
/// bytes per point: the partition's index, or -1 - index if others contain the point, too.
/// Collective.
void writeOwners(const FlatMesh& mesh, const BoxTiling& tiling, const std::string& path,
  Communicator& ranks, int threads);

/// Returns the chosen tiling of the mesh's domain. While a tree is built, `chunkCells` cells are in
/// memory, with two copies of their coordinates. Collective. Throws IOError if reading fails or
/// there are more than mostPieces boxes.
BoxTiling makeTiling(const FlatMesh& mesh, const TilingChoice& choice, const LoaderOptions& loading,
  std::int64_t chunkCells, int threads, Communicator& ranks, const Box3& domain);

/// Sets the mesh's domain, and adds a piece with unknown counts for each box.
void setPieces(PartitionedMesh& mesh, const Box3& domain, const BoxTiling& tiling);

} // namespace tipp

#endif
