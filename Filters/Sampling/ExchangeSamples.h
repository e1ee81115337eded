// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExchangeSamples_h
#define tippExchangeSamples_h

#include "Sampling/SampledImage.h"

namespace tipp
{

class Communicator;

/// Combines the samples of all ranks: for each sample of its lattice's extent, `result` gets the
/// one with the lowest key of any rank. Adds warnings about arrays that differ between ranks.
/// Extents may differ and be empty. Both images must be Merging. Each rank sends one message to
/// each rank whose extent overlaps. Collective.
void exchangeSamples(SampledImage& local, SampledImage& result, Communicator& ranks);

} // namespace tipp

#endif
