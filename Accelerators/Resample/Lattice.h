// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLattice_h
#define tippLattice_h

#include <array>
#include <cstdint>

namespace tipp
{

/// Samples at Min + i * Delta, for the indices of an extent as VTK's images have them: first and
/// last along x, y, z, both inclusive. The indices count from the whole lattice's origin, so that
/// parts of a lattice have the very same samples.
struct Lattice
{
  std::array<double, 3> Min = {};
  std::array<double, 3> Delta = { 1, 1, 1 };
  std::array<int, 6> Extent = {};

  std::int64_t size(int axis) const
  {
    return std::int64_t(this->Extent[2 * axis + 1]) - this->Extent[2 * axis] + 1;
  }
  std::int64_t samples() const { return this->size(0) * this->size(1) * this->size(2); }
  bool empty() const { return this->size(0) < 1 || this->size(1) < 1 || this->size(2) < 1; }
};

} // namespace tipp

#endif
