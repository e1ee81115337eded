// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippShareInitialMesh_h
#define tippShareInitialMesh_h

#include "Messages/Communicator.h"
#include "Triangulation/InitialMesh.h"

#include <cstddef>

namespace tipp
{

/// Returns all ranks' bytes, concatenated by rank, on all ranks. Collective.
Bytes joinedOnAllRanks(Communicator& ranks, Bytes&& own);

/// This rank's share of the initial mesh's triangles. Every rank triangulates all initial points.
/// Finding the partitions that the triangles meet takes longer, and is distributed if there are
/// enough vertices. `ranks` must outlive the result, whose Exchange is collective.
InitialMeshShare shareOf(Communicator& ranks, std::size_t vertices);

} // namespace tipp

#endif
