// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGeneratePoints_h
#define tippGeneratePoints_h

#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

/// Point sets for tests and benchmarks.
enum class Distribution
{
  /// Independent and uniform in the unit square.
  Uniform,
  /// 100 Gaussian clusters of equal weight, centres uniform in the unit square, standard deviations
  /// log-uniform in 1e-5 .. 1e-2; clusters in random order.
  Clustered,
  /// Kuzmin's disk, a model of galaxies: mass 1 - 1 / sqrt(1 + r^2) within radius r, so dense at
  /// the centre and unbounded (Blelloch, Hardwick, Miller and Talmor, Algorithmica 24, 1999; as in
  /// the Problem Based Benchmark Suite).
  Kuzmin,
  /// Integer points row by row, ceil(sqrt(count)) per row: many co-circular points. Not random.
  Lattice,
  /// Fractal shorelines, as of a storm-surge grid in degrees: closed polylines by midpoint
  /// displacement with unevenly deep subdivision, from a few continents down to islets around
  /// them, in polyline order, rounded to 6 decimals so that a few points coincide.
  Coast,
  /// Random points of the unit circle, each within an ulp or two of it: nearly co-circular.
  Circle,
  /// Distinct points k * (dx, dy) for k = 0 .. count - 1 in random order, dx and dy random integers
  /// below 1024: exactly collinear.
  Collinear
};

/// Returns `count` points, x and y interleaved; a seed gives the same numbers on every platform.
/// Throws std::invalid_argument if count is negative or above 2^40 (coordinates would no longer be
/// exact).
VTKTIPPIO_EXPORT std::vector<double> generatePoints(
  Distribution distribution, std::int64_t count, std::uint64_t seed);

/// @name Names in lower case, as on the command line
///@{
VTKTIPPIO_EXPORT std::optional<Distribution> distributionFromName(std::string_view name);
/// All names, in the order of the enumerators.
VTKTIPPIO_EXPORT std::vector<std::string> distributionNames();
///@}

} // namespace tipp

#endif
