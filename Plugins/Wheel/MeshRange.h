// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPythonMeshRange_h
#define tippPythonMeshRange_h

#include "Binding.h"

#include "Resample/Lattice.h"

#include <array>
#include <optional>
#include <vector>

namespace tipp::python
{

/// A range of a mesh and its samples, as Python gives them.
struct MeshRange
{
  std::array<double, 6> Bounds; ///< in VTK's order
  /// those of the points, if the range is to be checked against them
  std::optional<std::array<double, 6>> PointBounds;
  std::array<int, 3> Dimensions; ///< 0: chosen
  std::array<double, 3> Delta;   ///< 0: given by Dimensions
};

/// The samples of a range.
struct MeshSamples
{
  Lattice Grid;
  std::vector<int> Axes; ///< those along which a surface is sampled
};

/// Throws std::runtime_error for an invalid range, or one that is not sensible for the points.
MeshSamples samplesOf(const MeshRange& range, bool isSurface);

/// Returns the origin, spacing and numbers of samples.
nb::tuple describe(const Lattice& lattice);

} // namespace tipp::python

#endif
