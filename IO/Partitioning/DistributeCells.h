// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributeCells_h
#define tippDistributeCells_h

namespace tipp
{

struct PartitionRun;

/// Reads this rank's share of the cells chunk by chunk and spills each cell to the pieces that own
/// and borrow it, and the vertices that these need from other partitions. Collective. Throws
/// IOError.
///
/// A cell whose vertices all lie in one partition only lies inside that partition, which is convex.
/// Any other cell meets at least two partitions, which its coordinates determine.
void distributeCells(PartitionRun& run);

} // namespace tipp

#endif
