// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMakeDem_h
#define tippMakeDem_h

#include "Constraints/TableConstraints.h"
#include "Dem/TerrainSampler.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"
#include "Triangulation/ResolveDuplicates.h"
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
  int Threads = 0;        ///< 0: defaultThreads()
  DuplicateRule Duplicates = DuplicateRule::First; ///< which values coincident points get
  std::optional<TableConstraints> Constraints;     ///< see constrain()
  /// The box of the points that are there, if they are a part of all of them: see DemRegion. Only
  /// for points in a table, and without constraints.
  std::optional<Box2> Region = {};
  /// Whether Raster.Bounds must be sensible for the points: see requireSensible(). Not for points
  /// that were chosen by the raster, whose bounds are not those of all.
  bool StrictBounds = true;
};

/// The figures of a raster.
struct DemFigures : OutOfCoreStatistics
{
  bool IsOfPart = false; ///< of the points of a region
  bool NeedsMorePoints =
    false; ///< there is no raster, since it depends on points outside of the region
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
/// for bounds of a raster as requireSensible(), or if the boundary is nowhere near the points.
VTKTIPPFILTERS_EXPORT TerrainSettings makeTerrainSettings(
  const DemRequest& request, const Box2& bounds, const std::vector<std::string>& columns);

/// Makes a raster from points in memory: triangulates them and samples the triangles, with the same
/// result as in two steps. Consumes the points to save memory. Sets these members of the result:
/// Points (including those of the constraints), Triangles, Duplicates, DisagreeingPositions,
/// Rejected, WithoutElevation, Aborted and NeedsMorePoints. Throws std::runtime_error if there is
/// no finite point, and std::invalid_argument for invalid constraints.
VTKTIPPFILTERS_EXPORT DemFigures makeDem(PointTable points, const DemRequest& request,
  const std::function<bool(double)>& progress, TerrainSettings& settings, BandValues& samples);

/// Makes a raster in memory from the points of a stream; the values are those for the same points
/// in a table. `memory` limits the bytes for points and triangles; what does not fit is spilled to
/// a temporary folder; 0: no limit. The request has no Region. Throws IOError, std::runtime_error
/// if there is no finite point or a band's column is missing, and std::invalid_argument for invalid
/// constraints.
VTKTIPPFILTERS_EXPORT DemFigures makeDem(std::unique_ptr<PointStream> points,
  const DemRequest& request, std::uint64_t memory, const std::function<bool(double)>& progress,
  TerrainSettings& settings, BandValues& samples);

/// Points of files on their way to a raster. The functions may be null.
struct DemFiles
{
  std::vector<std::string> Paths;
  PointOptions Options;
  /// Called with the points before they are read.
  std::function<void(const PointStream& points)> Opened = {};
  /// Called with the points after they have been read: a part of them if `isPart`.
  std::function<void(const PointTable& points, bool isPart)> Read = {};
};

/// Makes a raster in memory from the points of files, of which it reads only those near the raster
/// if these are enough. It may have to read them more than once. The values are those for all
/// points. Throws as the functions above.
VTKTIPPFILTERS_EXPORT DemFigures makeDem(const DemFiles& files, const DemRequest& request,
  const std::function<bool(double)>& progress, TerrainSettings& settings, BandValues& samples);

} // namespace tipp

#endif
