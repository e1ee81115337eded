// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippImageOutput_h
#define tippImageOutput_h

#include "Resample/SampledImage.h"

#include <vector>

class vtkImageData;
class vtkPointSet;
class vtkTable;

namespace tipp
{

/// Throws std::runtime_error, with the bytes it takes, if the samples do not fit into this
/// machine's memory. `local` is what is sampled here, `wanted` what is put out; `exchanging` if
/// they are two.
void refuseTooLarge(const Lattice& local, const Lattice& wanted, bool exchanging,
  const std::vector<vtkPointSet*>& meshes, const SamplingSettings& settings);

/// Moves the arrays into the image, with vtkValidPointMask and vtkGhostType. Returns the number of
/// samples that are answered.
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

/// As the field data of an empty table.
void fillTable(const SamplingReport& report, vtkTable* table);

} // namespace tipp

#endif
