// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadSizes_h
#define tippReadSizes_h

#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Refinement/SizeFunction.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// What a user says about sizes. The size at a place is the smallest that a rule (Size, Dis,
/// WaveLength, Slope) allows there, then limited to [Least, Largest], and then by Gradation. Sizes
/// have the units of the coordinates, or are metres in the geographic plane.
struct SizeArguments
{
  std::string Size;   ///< a number, or the path of a file with sizes: see openPlaneValues()
  std::string Column; ///< of the file Size; empty: the column size

  std::string Depth; ///< the path of a file with depths in metres: see openPlaneValues()
  /// Of the file Depth; empty: the column depth, or the elevation if DepthIsElevation.
  std::string DepthColumn;
  bool DepthIsElevation = false; ///< whether the values of Depth are positive up, else down

  std::optional<double> Dis;        ///< see limitByDistance(); needs Least and a shoreline
  std::optional<double> WaveLength; ///< see limitByWavelength(); needs Depth
  std::optional<double> Slope;      ///< see limitBySlope(); needs Depth, Least and Largest
  std::optional<double> Least;
  std::optional<double> Largest;
  std::optional<double> Gradation; ///< see limitGradation()

  bool Geographic = false; ///< whether x and y are degrees of longitude and latitude
  /// The outer pixel borders of .npy files, which are rasters then; nullopt: they have points.
  std::optional<Box2> RasterBounds;
  /// The largest number of nodes of the size function, from 16 to 2^31 - 1. Each takes 8 bytes, and
  /// 8 more for depths while it is made.
  std::int64_t MostNodes = 16'000'000;
};

/// Makes the size function of a domain. A Size that is a number, alone in a projected plane, is a
/// constant. Else the sizes are computed at the nodes of a lattice over the domain, half the least
/// size apart: Least, or else the least size that the rules can give; farther if there were more
/// than MostNodes. See SizeFunction::spacing() for what follows from that.
///
/// `shoreline` has the segments from which Dis measures. `threads`: 0 for usualThreads(); the
/// result is the same for any number. Throws std::invalid_argument for arguments that are missing,
/// contradict each other or have no effect, IOError if a file cannot be read, has a size that is
/// not above 0 or lies outside of the domain, and WorkAborted if `report` stops it.
VTKTIPPFILTERS_EXPORT SizeFunction makeSizeFunction(const SizeArguments& arguments,
  const std::vector<std::array<Point2, 2>>& shoreline, const Box2& domain, int threads,
  const Report& report);

} // namespace tipp

#endif
