// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSamplingRange_h
#define tippSamplingRange_h

#include "Resample/Lattice.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

class vtkDataObject;
class vtkPointSet;

namespace tipp
{

class Postbox;

/// A class's triple as values.
template <std::size_t N, typename T>
std::array<T, N> toArray(const T (&values)[N])
{
  std::array<T, N> result;
  std::copy(values, values + N, result.begin());
  return result;
}

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

/// The meshes of a data object: itself or its leaves, in order. Throws std::runtime_error if one is
/// no vtkPointSet or does not pass checkCells().
std::vector<vtkPointSet*> meshesOf(vtkDataObject* data, int threads);

/// Whether the meshes of all ranks have no cell with a volume. Collective.
bool areSurfaces(const std::vector<vtkPointSet*>& meshes, Postbox& ranks);

/// The bounding box of the meshes of all ranks. Throws std::runtime_error on all ranks if there is
/// no point. Collective.
std::array<double, 6> boundsOf(const std::vector<vtkPointSet*>& meshes, Postbox& ranks);

/// The part of the lattice that the meshes' boxes meet along the axes, and all of it along others.
Lattice cropped(
  const Lattice& lattice, const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes);

} // namespace tipp

#endif
