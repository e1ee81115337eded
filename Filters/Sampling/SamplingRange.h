// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSamplingRange_h
#define tippSamplingRange_h

#include "Sampling/SampleNames.h"
#include "Sampling/SamplingLattice.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

class vtkDataObject;
class vtkPointSet;

namespace tipp
{

class Communicator;

/// The lowest and the highest finite z of meshes, and whether one has an array of elevations.
struct HeightRange
{
  double Low = HUGE_VAL;
  double High = -HUGE_VAL;
  bool HasArray = false;

  VTKTIPPFILTERS_EXPORT void add(vtkPointSet* mesh);
  /// Combines the ranges of all ranks, on all ranks. Collective.
  VTKTIPPFILTERS_EXPORT void gather(Communicator& ranks);

  bool isFlat() const { return !(this->Low < this->High); }
};

/// Whether the meshes of all ranks are surfaces whose points differ in z. Collective.
VTKTIPPFILTERS_EXPORT bool haveElevation(
  const std::vector<vtkPointSet*>& meshes, Communicator& ranks);

/// Returns a shallow copy of the mesh with z as the point array "elevation", in the type of the
/// coordinates; the mesh itself if it has an array of that name.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPointSet> withElevation(vtkPointSet* mesh);

/// Copies a C array, such as a VTK property, into a std::array.
template <std::size_t N, typename T>
std::array<T, N> toArray(const T (&values)[N])
{
  std::array<T, N> result;
  std::copy(values, values + N, result.begin());
  return result;
}

/// Returns the meshes of a data object: itself, or its leaves in order. Throws std::runtime_error
/// if one is not a vtkPointSet or fails checkDataSet(), whose message begins with `name`.
std::vector<vtkPointSet*> meshesOf(
  vtkDataObject* data, int threads, const std::string& name = "the input");

/// Returns `dimensions` with each 0 replaced by the number of samples that gives the spacing of the
/// first axis with a number; by 1 along z if the meshes of all ranks are surfaces. Throws
/// std::runtime_error if all are 0. Collective.
std::array<int, 3> chosenDimensions(const Box3& bounds, const std::array<int, 3>& dimensions,
  const std::vector<vtkPointSet*>& meshes, Communicator& ranks);

/// Returns the bounding box of all ranks' meshes. Throws std::runtime_error
/// on all ranks if there are no points. Collective.
Box3 boundsOf(const std::vector<vtkPointSet*>& meshes, Communicator& ranks);

/// Throws std::runtime_error on all ranks, as requireSensible() of Predicates, for a range of all
/// ranks' meshes. `axes`: those along which surfaces are sampled. Collective.
void requireSensible(const Box3& range, const std::vector<vtkPointSet*>& meshes,
  const std::vector<int>& axes, Communicator& ranks);

/// Returns the part of the lattice that the meshes' bounding boxes meet along `axes`; along other
/// axes it is not cropped.
Lattice cropped(
  const Lattice& lattice, const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes);

} // namespace tipp

#endif
