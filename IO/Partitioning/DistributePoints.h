// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributePoints_h
#define tippDistributePoints_h

namespace tipp
{

struct PartitionRun;

/// Reads this rank's share of the points in one pass and spills each to its owner and to the other
/// pieces that need it. Collective. Throws IOError.
void distributePoints(PartitionRun& run);

} // namespace tipp

#endif
