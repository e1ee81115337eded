// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippToolRankStatistics_h
#define tippToolRankStatistics_h

#include "Distributed/DistributedStatistics.h"

#include <nlohmann/json.hpp>

namespace tipp
{

/// The statistics of a run on ranks: per rank, per master and per kind of message.
nlohmann::ordered_json describe(const DistributedStatistics& statistics);

} // namespace tipp

#endif
