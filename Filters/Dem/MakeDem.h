// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMakeDem_h
#define tippMakeDem_h

#include "Constraints/TableConstraints.h"
#include "Dem/TerrainSampler.h"
#include "Dem/TileStore.h"
#include "Duplicates/ResolveDuplicates.h"
#include "Points/PointTable.h"
#include "Predicates/Points.h"
#include "Raster/RasterFile.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// What a raster of points is to be.
struct DemRequest
{
  RasterRequest Raster;
  std::vector<std::string> Bands = { "elevation" };
  double MaximumEdge = 0; ///< triangles with a longer one are void; 0: none are
  int Threads = 0;        ///< 0: OpenMP's choice
  DuplicateRule Duplicates = DuplicateRule::First;
  std::optional<TableConstraints> Constraints; ///< breaklines and a boundary
};

/// Drops the heights of lines of a VTK file, all of whose points have one, if they are 0.
VTKTIPPFILTERS_EXPORT void dropPlainHeights(ConstraintTable& lines);

/// Of points with these columns between these bounds. Throws std::runtime_error.
VTKTIPPFILTERS_EXPORT TerrainSettings makeTerrainSettings(
  const DemRequest& request, const Box2& bounds, const std::vector<std::string>& columns);

/// Throws std::runtime_error if the pixels cannot be in this machine's memory.
void requireMemory(const TerrainSettings& settings);

struct DemFigures
{
  std::int64_t Points = 0;
  std::int64_t Triangles = 0;
  std::int64_t Duplicates = 0;
  std::int64_t DisagreeingPositions = 0; ///< of several points with different elevations
  std::int64_t Rejected = 0;             ///< points that are not finite
  bool Aborted = false;
};

/// A raster of points in memory: triangulates them and samples the triangles, as two steps would.
/// Takes the points' memory. Throws std::runtime_error if there is no finite point, and
/// std::invalid_argument for constraints.
VTKTIPPFILTERS_EXPORT DemFigures makeDem(PointTable points, const DemRequest& request,
  const std::function<bool(double)>& progress, TerrainSettings& settings, SampledBands& samples);

/// Where the tiles of a raster are; used by several threads at once.
struct TileSource
{
  /// Gives the values of a tile.
  std::function<void(const RasterWindow&, std::vector<std::vector<double>>&)> Read;
  /// The tile of a number if it is finished; null: none is.
  std::function<std::optional<FinishedTile>(std::int64_t)> ReadFinished;
};

/// Samples of a whole grid. Both must outlive the result.
VTKTIPPFILTERS_EXPORT TileSource readFrom(const RasterGrid& grid, const SampledBands& samples);

/// Sets the values of voids, see fillVoids(), and returns how many pixels of the first band have a
/// value without that.
std::int64_t fillTile(const DemBands& bands, std::vector<std::vector<double>>& values);

std::vector<const double*> pointersTo(const std::vector<std::vector<double>>& values);

/// Writes all tiles. `bands`: those whose voids are to be filled, see fillVoids(). Returns the
/// pixels whose first band has a value from a triangle, or -1 if `progress` ended it. `threads`: 0
/// is OpenMP's choice. Throws IOError.
VTKTIPPFILTERS_EXPORT std::int64_t writeTiles(RasterWriter& writer, const RasterGrid& grid,
  const TileSource& tiles, const std::function<bool(double)>& progress, int threads,
  const DemBands& bands = {});

} // namespace tipp

#endif
