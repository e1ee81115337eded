// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAssemblePieces_h
#define tippAssemblePieces_h

namespace tipp
{

struct PartitionRun;

/// Writes the pieces' files, each rank a share of equal weight; then the first rank writes tables,
/// .pvtu and index. All are synced on return. Collective. Throws IOError.
void assemblePieces(PartitionRun& run);

} // namespace tipp

#endif
