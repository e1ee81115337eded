// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExchangeSamples_h
#define tippExchangeSamples_h

#include "Resample/SampledImage.h"

class vtkMultiProcessController;

namespace tipp
{

/// Puts together what all ranks have sampled: `result` gets, for the extent of its lattice, the
/// sample of lowest key of any rank. Every rank calls it; extents differ and may be empty. Both
/// images are Merging. One message goes from each rank to each whose extents overlap.
void exchangeSamples(
  SampledImage& local, SampledImage& result, vtkMultiProcessController* controller);

} // namespace tipp

#endif
