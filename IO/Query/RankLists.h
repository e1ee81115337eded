// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankLists_h
#define tippRankLists_h

#include "Query/Around.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

using Ids = std::vector<std::int64_t>;

/// Returns a list for each id; pieces[i] has all cells at ids[i] (points) or owns ids[i] (cells).
using ListWork = std::function<IdLists(
  const ResidentMesh& mesh, const Ids& ids, const std::vector<std::int32_t>& pieces)>;

/// Returns the lists of this rank's ids. With several ranks, one rank that has an id computes its
/// list: `work` runs on every rank, for the ids that the ranks ask of it, possibly none. Collective
/// if there are several ranks. Throws IOError for an id that no rank has.
IdLists listsOf(const ResidentMesh& mesh, const Ids& ids, bool ofPoints, Communicator* ranks,
  const ListWork& work);

} // namespace tipp

#endif
