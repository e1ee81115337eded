// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMadeMesh_h
#define tippMadeMesh_h

#include "Arrays/Buffer.h"
#include "Constraints/TableConstraints.h"
#include "Files/Formats.h"
#include "Files/PendingOutput.h"
#include "Meshes/MeshFiles.h"
#include "Points/ReadPoints.h"
#include "Refinement/ModelBoundaries.h"
#include "Refinement/NodeDepths.h"
#include "Refinement/ReadSizes.h"
#include "Refinement/Refine.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace tipp
{

class PagedMemory;

/// The options of 'tipp mesh'.
struct MeshArguments
{
  ConstraintFiles Constraints;
  std::vector<std::string> Points; ///< files of further vertices
  std::string Output;
  std::string Statistics; ///< path of a file; empty: none
  bool Convex = false;

  double MinimumAngle = 30;
  double LargestArea = 0; ///< 0: not given
  double ShortestEdge = 0;
  std::int64_t MostPoints = 0;
  int SmoothingRounds = 0;
  bool KeepBorder = false;
  bool KeepSegments = false;
  std::vector<std::tuple<double, double, double>> Regions; ///< x, y and the largest area
  std::string RegionFile;                                  ///< path; empty: not given
  SizeArguments Sizes;

  bool DepthsAtNodes = false;
  std::string OpenPolygon; ///< path; empty: not given
  std::optional<double> OpenDepth;
  bool KeepOrder = false;
  std::string Memory;  ///< the limit; empty: the mesh is in memory
  std::string Scratch; ///< a folder; empty: that of the output
  int Threads = 0;

  Opener OutputIs = Opener::None;

  bool hasSizes() const
  {
    return !this->Sizes.Size.empty() || this->Sizes.Dis || this->Sizes.WaveLength ||
      this->Sizes.Slope;
  }
  bool depthsAreRaster() const
  {
    const std::string& path = this->Sizes.Depth;
    return formatOf(path, Use::Rasters) ||
      (this->Sizes.RasterBounds && isOpenedBy(path, Opener::Npy));
  }
  bool hasBoundaryLists() const { return this->OutputIs == Opener::Adcirc; }
  bool isOpen() const { return this->OpenDepth || !this->OpenPolygon.empty(); }
  bool sizesNeedDepths() const { return this->Sizes.WaveLength || this->Sizes.Slope; }
};

/// The mesh, and what its statistics are made from.
struct MadeMesh
{
  PointTable Points;       ///< all nodes, or those before the added ones
  Buffer<double> NewXY;    ///< with --memory: of the crossings and the added points
  std::size_t InTable = 0; ///< the number of crossings, which Points has, too
  /// With --memory: by column of Points, whose own values are empty then, those of all nodes.
  std::vector<Buffer<double>> Columns;
  Buffer<std::int32_t> Triangles;
  Buffer<std::int32_t> Regions;
  std::vector<std::array<std::int64_t, 2>> Segments;
  RefinedMesh Refined; ///< its triangles and points have been moved from
  std::int64_t GivenPoints = 0;
  std::int64_t LeftOut = 0; ///< points that are not in the domain
  std::optional<NodeDepths> Depths;
  ModelBoundaries Boundaries;
  std::int64_t Bandwidth = 0;

  std::size_t nodeCount() const
  {
    return this->Points.size() + this->NewXY.size() / 2 - this->InTable;
  }
  /// The nodes with their columns, of which depths are the last one.
  NodesView nodes() const;
};

/// Reads the input and makes the mesh, in `memory` unless that is null, without depths and
/// boundaries. Prints warnings. Returns false if the user interrupted it. Throws IOError,
/// std::invalid_argument.
bool makeMesh(const MeshArguments& arguments, PagedMemory* memory, MadeMesh& made);

/// Orders the nodes, and adds depths, in `memory` unless that is null, and boundaries, as the
/// options say. Throws IOError.
void completeMesh(const MeshArguments& arguments, PagedMemory* memory, MadeMesh& made);

/// Writes the output. `before`: its path's state before the run. Returns false if the user
/// interrupted it. Throws IOError.
bool writeMade(const MeshArguments& arguments, const MadeMesh& made, const PathState& before);

} // namespace tipp

#endif
