// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSamplingLattice_h
#define tippSamplingLattice_h

#include "Resample/Lattice.h"

#include <array>
#include <vector>

namespace tipp
{

/// Puts numbers where `dimensions` is 0: as many samples as put them as far apart as along the
/// first axis that has a number, but one along z for surfaces. Throws std::runtime_error if all are
/// 0.
std::array<int, 3> chosenDimensions(
  const std::array<double, 6>& bounds, std::array<int, 3> dimensions, bool surfaces);

/// The number of samples along each axis of a range: by delta where it is above 0, else
/// `dimensions`. Throws std::runtime_error for a range or a number that makes no sense.
std::array<int, 3> rangeDimensions(const std::array<double, 6>& bounds,
  const std::array<int, 3>& dimensions, const std::array<double, 3>& delta);

/// The whole lattice of a range. Where `dimensions` counts, the last sample is not beyond the
/// range.
Lattice rangeLattice(const std::array<double, 6>& bounds, const std::array<int, 3>& dimensions,
  const std::array<double, 3>& delta);

/// The two axes that surface cells are sampled along: all but the last with one sample, or z.
std::vector<int> surfaceAxes(const std::array<int, 3>& dimensions);

/// Throws std::runtime_error if this machine does not have the bytes that so many samples need.
void requireMemory(double samples, double bytes);

} // namespace tipp

#endif
