// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExchangeSamples_h
#define tippExchangeSamples_h

#include "Resample/SampledImage.h"

namespace tipp
{

class Postbox;

/// Puts together what all ranks have sampled: `result` gets, for the extent of its lattice, the
/// sample of lowest key of any rank, and warnings of arrays that differ between ranks. Extents
/// differ and may be empty. Both images are Merging. One message goes from each rank to each whose
/// extents overlap. Collective.
void exchangeSamples(SampledImage& local, SampledImage& result, Postbox& ranks);

} // namespace tipp

#endif
