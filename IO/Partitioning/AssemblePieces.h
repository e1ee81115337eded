// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAssemblePieces_h
#define tippAssemblePieces_h

namespace tipp
{

struct PartitionRun;

/// Writes the pieces' files, each rank a share of equal weight, then, on the first rank, tables,
/// .pvtu and index; all are safe on the disk on return. A call of all ranks. Throws IOError.
void assemblePieces(PartitionRun& run);

} // namespace tipp

#endif
