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

/// Returns a list for each id; pieces[i] owns ids[i].
using ListWork = std::function<IdLists(
  const ResidentMesh& mesh, const Ids& ids, const std::vector<std::int32_t>& pieces)>;

/// The lists of this rank's ids. With several ranks, each is made by a rank that has the id:
/// `work` gets the ids of all ranks, maybe none. Throws IOError for an id that no rank has.
IdLists listsOf(const ResidentMesh& mesh, const Ids& ids, bool ofPoints, Communicator* ranks,
  const ListWork& work);

} // namespace tipp

#endif
