// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHiddenSamples_h
#define tippHiddenSamples_h

#include "Resample/Lattice.h"

#include <cstdint>

namespace tipp
{

/// @name The array vtkGhostType of an image
/// They set all of `ghosts`: to what VTK has for hidden points and cells, or to 0. `valid` is 1 at
/// samples that have a value, else 0.
///@{
/// Hides samples that are not valid. Returns the number of valid ones.
std::int64_t markHiddenSamples(
  const unsigned char* valid, std::int64_t samples, int threads, unsigned char* ghosts);

/// Hides the cells between samples of which one is not valid.
void markHiddenCells(
  const Lattice& lattice, const unsigned char* valid, int threads, unsigned char* ghosts);

/// The number of cells between the samples.
std::int64_t cellsBetween(const Lattice& lattice);
///@}

} // namespace tipp

#endif
