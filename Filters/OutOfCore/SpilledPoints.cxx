// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/SpilledPoints.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

std::vector<std::int64_t> startsOf(const std::vector<std::int64_t>& counts)
{
  std::vector<std::int64_t> starts(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
  return starts;
}

SpilledPoints::SpilledPoints(
  const std::string& file, std::size_t words, const std::vector<SpilledRows>& parts)
  : Rows(file, parts.front().Counts.size(), 8 * words, parts)
  , Starts(startsOf(this->Rows.content().Counts))
{
}

SpilledPoints::SpilledPoints(
  const std::string& file, std::size_t words, PartitionIndex pieces, LoadArchive& archive)
  : Rows(file, std::size_t(pieces), 8 * words, archive.get<SpilledRows>())
  , Starts(startsOf(this->Rows.content().Counts))
{
}

void SpilledPoints::save(SaveArchive& archive) const
{
  archive(this->Rows.content());
}

PartitionIndex SpilledPoints::pieceOf(std::int64_t index) const
{
  return PartitionIndex(
    std::upper_bound(this->Starts.begin(), this->Starts.end(), index) - this->Starts.begin() - 1);
}

} // namespace tipp
