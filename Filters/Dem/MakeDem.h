// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMakeDem_h
#define tippMakeDem_h

#include "Constraints/TableConstraints.h"
#include "Dem/TerrainSampler.h"
#include "Dem/TileStore.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"
#include "Triangulation/ResolveDuplicates.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The parameters of a raster of points.
struct DemRequest
{
  RasterRequest Raster; ///< the pixel grid
  std::vector<std::string> Bands = { "elevation" };
  double MaximumEdge = 0; ///< longest edge of triangles, in the points' unit of length; 0: no limit
  int Threads = 0;        ///< 0: OpenMP's default
  DuplicateRule Duplicates = DuplicateRule::First; ///< which values coincident points get
  std::optional<TableConstraints> Constraints;     ///< see constrain()
};

/// Sets request.Constraints from breaklines and a boundary, either of which may be missing. Set
/// request.Duplicates first. Polygons among the breaklines count as lines, too. Heights of the
/// boundary are not used.
VTKTIPPFILTERS_EXPORT void constrain(DemRequest& request, std::optional<ConstraintTable> lines,
  std::optional<ConstraintTable> boundary);

/// Reads breaklines. Heights from a VTK file are dropped if all are 0. Throws IOError.
VTKTIPPFILTERS_EXPORT ConstraintTable readBreaklines(const std::string& path, int wrap = 0);

/// Removes the heights of lines if all are 0. For lines from VTK, which always have heights.
VTKTIPPFILTERS_EXPORT void dropPlainHeights(ConstraintTable& lines);

/// Returns whether lines have heights and all are 0, as those that CAD programs write for lines
/// without heights.
VTKTIPPFILTERS_EXPORT bool haveZeroHeights(const ConstraintTable& lines);

/// Returns the heights of the surface of the points at the ends of lines; NaN outside of it, and
/// none at all if the points have no column of heights.
VTKTIPPFILTERS_EXPORT std::vector<double> heightsBelow(
  const ConstraintTable& lines, const PointTable& points, int threads);

/// Returns the settings for points with these bounds and columns. Throws std::runtime_error, also
/// if the raster's bounds are in GDAL's order, or if the boundary is nowhere near the points.
VTKTIPPFILTERS_EXPORT TerrainSettings makeTerrainSettings(
  const DemRequest& request, const Box2& bounds, const std::vector<std::string>& columns);

/// Makes a raster from points in memory: triangulates them and samples the triangles, with the same
/// result as in two steps. Consumes the points to save memory. Sets these members of the result:
/// Points (including those of the constraints), Triangles, Duplicates, DisagreeingPositions,
/// Rejected, WithoutElevation and Aborted. Throws std::runtime_error if there is no finite point,
/// and std::invalid_argument for invalid constraints.
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics makeDem(PointTable points, const DemRequest& request,
  const std::function<bool(double)>& progress, TerrainSettings& settings, BandValues& samples);

/// Makes a raster in memory from the points of a stream; the values are those for the same points
/// in a table. `memory` limits the bytes for points and triangles; what does not fit is spilled to
/// a temporary folder; 0: no limit. Throws IOError, std::runtime_error if there is no finite point
/// or a band's column is missing, and std::invalid_argument for invalid constraints.
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics makeDem(std::unique_ptr<PointStream> points,
  const DemRequest& request, std::uint64_t memory, const std::function<bool(double)>& progress,
  TerrainSettings& settings, BandValues& samples);

} // namespace tipp

#endif
