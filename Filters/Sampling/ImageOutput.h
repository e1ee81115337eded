// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippImageOutput_h
#define tippImageOutput_h

#include "Sampling/SampledImage.h"

#include <cstdint>

class vtkImageData;
class vtkTable;

namespace tipp
{

class Communicator;

/// Combines the samples of all ranks: for each sample of its lattice's extent, `result` gets the
/// one with the lowest key of any rank. Adds warnings about arrays that differ between ranks.
/// Extents may differ and be empty. Both images must be Merging. Each rank sends one message to
/// each rank whose extent overlaps. Collective.
void exchangeSamples(SampledImage& local, SampledImage& result, Communicator& ranks);

/// Moves the arrays into the image, with vtkValidPointMask and vtkGhostType. Returns the number of
/// valid samples.
std::int64_t fillImage(SampledImage& samples, int threads, vtkImageData* image);

/// Writes statistics to the field data of `table`. `hits`: how many of the output's samples have
/// values.
void fillTable(const SamplingStatistics& statistics, std::int64_t samples, std::int64_t hits,
  int threads, vtkTable* table);

} // namespace tipp

#endif
