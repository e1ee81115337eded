// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributeCells_h
#define tippDistributeCells_h

namespace tipp
{

struct PartitionRun;

/// Reads this rank's share of the cells chunk by chunk and spills each to the pieces that own and
/// borrow it, and the vertices that these need from other partitions. A call of all ranks. Throws
/// IOError.
///
/// A cell whose vertices all have the same home, and no other, lies inside that partition, which is
/// convex. Any other cell meets two partitions at least, and which is decided by its coordinates.
void distributeCells(PartitionRun& run);

} // namespace tipp

#endif
