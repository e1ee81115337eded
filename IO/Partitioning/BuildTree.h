// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBuildTree_h
#define tippBuildTree_h

#include "Partition/BoxTiling.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

/// A mesh's cells, to be read chunk by chunk and more than once.
struct CellSource
{
  int Dimension;      ///< coordinates of a corner: 2 or 3
  int Corners;        ///< 3 for triangles, 4 for tetrahedra
  std::int64_t Cells; ///< of the whole mesh
  /// Gives `count` cells from cell `first` on, all corners' coordinates cell after cell. Called
  /// on the calling thread, by each rank for its share of the cells; may throw.
  std::function<void(std::int64_t first, std::int64_t count, std::vector<double>& coordinates)>
    Read;
};

struct TreeOptions
{
  /// Of the tree, 2 or 3: a quadtree takes triangles in space by their x and y.
  int Dimension = 2;
  /// A leaf with more cells is split.
  std::int64_t Threshold = 100000;
  /// Levels below the root, at most BoxTiling::MaxDepth.
  int MaxDepth = BoxTiling::MaxDepth;
  /// Cells to read at once.
  std::int64_t ChunkCells = std::int64_t(1) << 20;
  int Threads = 0; ///< 0: OpenMP's choice
};

struct PartitionTree
{
  BoxTiling Tiling;
  std::vector<std::int64_t> Cells; ///< by partition: how many cells meet it
  int Passes;                      ///< how often the cells were read
};

/// The quadtree or octree over the domain in which every node with more than Threshold cells is
/// split (algorithm 6 of the dissertation). It counts the cells that meet the node's closed box,
/// decided exactly, and are no longer than it (longest side of the bounding box against longest
/// side of the node). So the tree depends on the cells alone, not on their order, the ranks, the
/// threads or the chunks.
///
/// The dissertation counts all cells that meet a node. Then cells that share a point, or slivers
/// beside each other, are split for ever, since their number does not fall; the longer ones are
/// left out for that reason. Each level then has at most 2^d Cells / Threshold splits in a domain
/// of equal sides. MaxDepth ends what is left: many tiny cells at one place.
///
/// Each rank reads an equal share of the cells and builds a tree of its own; the trees' structures
/// are merged two by two and given back; then the cells are counted in the common tree, and that is
/// repeated while it grows. A rank that sees one chunk of its share after the other splits early,
/// at a quarter (or an eighth) of the threshold, so that the second reading mostly finds the tree
/// complete; what was split too far is joined again at the end. A mesh of one chunk, on one rank,
/// is read once.
///
/// Throws IOError, on all ranks if on one: for cells with coordinates that are not finite or
/// outside the domain, a threshold below 1, and a tree that would be too large. Without a
/// controller, or with a dummy one, this process is alone.
VTKTIPPIO_EXPORT PartitionTree buildTree(const CellSource& cells, const Box3& domain,
  const TreeOptions& options, vtkMultiProcessController* controller = nullptr);

} // namespace tipp

#endif
