// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSamplingRange_h
#define tippSamplingRange_h

#include "Sampling/SamplingLattice.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

class vtkDataObject;
class vtkPointSet;

namespace tipp
{

class Communicator;

/// Copies a C array, such as a VTK property, into a std::array.
template <std::size_t N, typename T>
std::array<T, N> toArray(const T (&values)[N])
{
  std::array<T, N> result;
  std::copy(values, values + N, result.begin());
  return result;
}

/// Returns the meshes of a data object: itself, or its leaves in order. Throws std::runtime_error
/// if one is not a vtkPointSet or fails checkCells().
std::vector<vtkPointSet*> meshesOf(vtkDataObject* data, int threads);

/// Whether no mesh of any rank has a three-dimensional cell. Collective.
bool areSurfaces(const std::vector<vtkPointSet*>& meshes, Communicator& ranks);

/// Returns the bounding box of all ranks' meshes (xmin, xmax, ymin, ...). Throws std::runtime_error
/// on all ranks if there are no points. Collective.
std::array<double, 6> boundsOf(const std::vector<vtkPointSet*>& meshes, Communicator& ranks);

/// Returns the part of the lattice that the meshes' bounding boxes meet along `axes`; along other
/// axes it is not cropped.
Lattice cropped(
  const Lattice& lattice, const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes);

} // namespace tipp

#endif
