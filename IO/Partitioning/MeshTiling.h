// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshTiling_h
#define tippMeshTiling_h

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "Partition/BoxTiling.h"
#include "Partitioned/PartitionedMesh.h"
#include "Predicates/Geometry.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkMultiProcessController;

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

/// A growing quadtree or octree over a domain. Nodes are numbered in the order of creation,
/// siblings consecutively.
class VTKTIPPIO_EXPORT RefinementTree
{
public:
  RefinementTree(int dimension, const Box3& domain);

  int dimension() const { return this->Dimension; }
  const Box3& domain() const { return this->Boxes[0]; }
  std::size_t size() const { return this->FirstChild.size(); }
  int childCount() const { return this->ChildCount; }

  /// The index of the node's first child, or -1.
  std::int32_t firstChild(std::int32_t node) const { return this->FirstChild[at(node)]; }
  bool isLeaf(std::int32_t node) const { return this->firstChild(node) < 0; }
  const Box3& box(std::int32_t node) const { return this->Boxes[at(node)]; }
  /// The longest side of the node's box.
  double length(std::int32_t node) const;

  /// Whether the node may be split: its depth is less than BoxTiling::MaxDepth, and its halves
  /// differ in doubles.
  bool canSplit(std::int32_t node) const;
  /// Adds a leaf's children. Throws IOError if the tree would be too large.
  void split(std::int32_t leaf);

  /// The tree in depth-first order: '1' for a split node, followed by its children, '0' for a leaf.
  std::string structure() const;
  /// Adds the splits of another tree, given by its structure. Throws IOError if that is invalid.
  void refine(const std::string& structure);

  /// Returns the tiling of the tree in which nodes for which keep() returns false are leaves.
  BoxTiling tiling(const std::function<bool(std::int32_t)>& keep) const;

private:
  static std::size_t at(std::int32_t node) { return static_cast<std::size_t>(node); }

  int Dimension;
  int ChildCount;
  std::vector<std::int32_t> FirstChild;
  std::vector<Box3> Boxes;
  std::vector<std::uint8_t> Depths;
};

/// A mesh's cells, which are read chunk by chunk and more than once.
struct CellSource
{
  int Dimension;      ///< coordinates per corner: 2 or 3
  int Corners;        ///< 3 for triangles, 4 for tetrahedra
  std::int64_t Cells; ///< number of cells of the whole mesh
  /// Writes the corners' coordinates of `count` cells from index `first` on, cell after cell. Each
  /// rank calls it on the calling thread for its share of the cells; may throw.
  std::function<void(std::int64_t first, std::int64_t count, std::vector<double>& coordinates)>
    Read;
};

/// Options of buildTree().
struct TreeOptions
{
  /// Leaves with more cells than this are split; see buildTree(). At least 1.
  std::int64_t Threshold = 100000;
  /// Number of cells read at once, from 1 to 2^30.
  std::int64_t ChunkCells = std::int64_t(1) << 20;
  int Threads = 0; ///< 0: defaultThreads()
};

/// Builds the quadtree or octree over the domain in which every node with more than Threshold cells
/// is split (Algorithm 6 of the dissertation). A node counts the cells that meet its closed box,
/// decided exactly, and are no longer than it (longest side of the bounding box against longest
/// side of the node). So the tree depends only on the cells, not on their order, the ranks, the
/// threads or the chunks.
///
/// The dissertation counts all cells that meet a node. Then splitting would not terminate at cells
/// that share a point or at adjacent slivers, since splitting does not reduce their number. So
/// a node does not count cells that are longer than its box. In a domain of equal sides each level
/// then has at most 2^d Cells / Threshold splits. BoxTiling::MaxDepth bounds the remaining case:
/// many tiny cells in one location.
///
/// Each rank reads an equal share of the cells and builds a tree of its own. The trees' structures
/// are merged in pairs and broadcast; then the cells are counted in the common tree, and that is
/// repeated while it grows. A rank whose share has several chunks splits early, at a quarter (or an
/// eighth) of the threshold, so that the second pass usually finds the tree complete; excess splits
/// are undone at the end. A mesh of one chunk on one rank is read once.
///
/// Throws IOError, on all ranks if on one: for cells with coordinates that are not finite or
/// outside the domain, or a tree that would be too large. A null or dummy controller means
/// serial.
VTKTIPPIO_EXPORT BoxTiling buildTree(const CellSource& cells, const Box3& domain,
  const TreeOptions& options, vtkMultiProcessController* controller = nullptr);

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
  points.Type == Scalar::Float32 ? takeCoordinatesAs<float>(raw, count, components, dimension, to)
                                 : takeCoordinatesAs<double>(raw, count, components, dimension, to);
}

/// Loads the coordinates of the points with these ids: two each for triangles, three for
/// tetrahedra. Throws IOError.
std::vector<double> loadCoordinates(
  const FlatMesh& mesh, VertexLoader& loader, const std::vector<std::int64_t>& ids);

/// Returns the bounding box of all points in the cells' dimension; for triangles z is 0. Throws
/// IOError naming the first point with a coordinate that is not finite. Collective.
VTKTIPPIO_EXPORT Box3 boundsOfPoints(const FlatMesh& mesh, Communicator& ranks, int threads);

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

/// Assigns each rank a run of consecutive pieces, which are numbered along the Morton curve, so
/// that the heaviest run is as light as possible. Returns ranks + 1 numbers: rank r has pieces
/// [result[r], result[r + 1]). If there are more ranks than pieces, the last ranks get empty runs;
/// no other run is empty. Negative weights count as 0; `ranks` below 1 as 1.
VTKTIPPIO_EXPORT std::vector<std::size_t> assignPieces(
  std::vector<std::int64_t> weights, int ranks);

} // namespace tipp

#endif
