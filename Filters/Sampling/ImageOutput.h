// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippImageOutput_h
#define tippImageOutput_h

#include "Sampling/SampledImage.h"

#include <vector>

class vtkImageData;
class vtkPointSet;
class vtkTable;

namespace tipp
{

/// Throws std::runtime_error, stating the bytes needed, if the samples do not fit into this
/// machine's memory. `local` is the lattice sampled on this rank, `wanted` the lattice of its
/// output; `exchanging` is true if they differ.
void refuseTooLarge(const Lattice& local, const Lattice& wanted, bool exchanging,
  const std::vector<vtkPointSet*>& meshes, const SamplingSettings& settings);

/// Moves the arrays into the image, with vtkValidPointMask and vtkGhostType. Returns the number of
/// valid samples.
std::int64_t fillImage(SampledImage& samples, int threads, vtkImageData* image);

struct SamplingReport
{
  SamplingStatistics Statistics;
  std::int64_t Samples = 0;
  std::int64_t Hits = 0;
  int Threads = 1;
  double ExchangeSeconds = 0;
  double OutputSeconds = 0;
};

/// Writes the report to the field data of an empty table.
void fillTable(const SamplingReport& report, vtkTable* table);

} // namespace tipp

#endif
