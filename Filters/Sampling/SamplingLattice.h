// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSamplingLattice_h
#define tippSamplingLattice_h

#include "Predicates/Geometry.h"
#include "Resample/Lattice.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Returns `dimensions` with each 0 replaced by the number of samples that gives the spacing of the
/// first axis with a number; by 1 along z for surfaces. Throws std::runtime_error if all are 0.
VTKTIPPFILTERS_EXPORT std::array<int, 3> chosenDimensions(
  const Box3& bounds, std::array<int, 3> dimensions, bool surfaces);

/// Returns the lattice of a range: along each axis with the spacing `delta` if it is above 0, else
/// with `dimensions` samples, the last of them not beyond the range. Only steps of a given length,
/// which are on a grid of written numbers, have a Slack. Throws std::runtime_error for
/// an invalid range or number.
Lattice rangeLattice(
  const Box3& bounds, const std::array<int, 3>& dimensions, const std::array<double, 3>& delta);

/// Returns what to say if the samples of a range are so far apart, by a given `distance`, that
/// there is one; empty if there are more, or if the distance is 0, not given.
VTKTIPPFILTERS_EXPORT std::string warningOfOneSample(std::int64_t samples, double distance);

/// Returns the two axes that surface cells are sampled along: all except the last axis with one
/// sample, or except z.
std::vector<int> surfaceAxes(const std::array<int, 3>& dimensions);

/// Throws std::runtime_error unless the samples of a lattice, along the `axes` of a surface, are
/// the centres of pixels in one layer whose widths are known.
VTKTIPPFILTERS_EXPORT void requirePixels(const Lattice& lattice, const std::vector<int>& axes);

/// Throws std::runtime_error if this machine does not have the `bytes` bytes that `samples` samples
/// need.
void requireMemory(double samples, double bytes);

} // namespace tipp

#endif
