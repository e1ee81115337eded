// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSamplingRange_h
#define tippSamplingRange_h

#include "Resample/SamplingLattice.h"

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
