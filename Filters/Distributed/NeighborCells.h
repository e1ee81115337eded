// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNeighborCells_h
#define tippNeighborCells_h

#include "Arrays/Buffer.h"
#include "Arrays/FindNeighbors.h"
#include "Distributed/CellExchange.h"
#include "Ranks/Communicator.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Returns for each of this rank's cells and then of the ghosts, which have `size` corners each,
/// and for each corner the global id of the cell across the opposite edge or facet, or -1. `cells`:
/// this rank's, by internal ids. `ghosts`: of fetchGhosts(). Collective.
template <std::size_t N, typename Position>
Buffer<std::int64_t> neighborIdsOf(Communicator& ranks, const DistributedPoints<Position>& mine,
  const std::vector<IdCell<N>>& cells, const GhostCells<N, Position>& ghosts, std::size_t size)
{
  std::vector<std::int64_t> corners;
  corners.reserve(size * (cells.size() + ghosts.Cells.size()));
  for (const std::vector<IdCell<N>>* list : { &cells, &ghosts.Cells })
  {
    for (const IdCell<N>& cell : *list)
    {
      corners.insert(corners.end(), cell.begin(), cell.begin() + std::ptrdiff_t(size));
    }
  }
  Buffer<std::int64_t> ids(corners.size());
  size == 3 ? findNeighbors<3>(corners.data(), corners.size() / 3, ids.data())
            : findNeighbors<4>(corners.data(), corners.size() / 4, ids.data());
  const auto own = std::int64_t(cells.size());
  std::transform(ids.begin(), ids.end(), ids.begin(),
    [&](std::int64_t cell)
    {
      return cell < 0 ? -1
        : cell < own  ? mine.FirstCell + cell
                      : ghosts.Numbers[std::size_t(cell - own)];
    });
  // A ghost may have neighbours that this rank does not know, so its owner sends them.
  std::vector<std::int64_t> firsts = ranks.allGather(mine.FirstCell);
  firsts.push_back(mine.AllCells);
  std::vector<std::vector<std::int64_t>> asked(std::size_t(ranks.size()));
  for (const std::int64_t number : ghosts.Numbers)
  {
    asked[ownerOf(number, firsts)].push_back(number);
  }
  std::vector<std::vector<std::int64_t>> answers;
  for (const std::vector<std::int64_t>& numbers : ranks.allToAll(asked))
  {
    answers.emplace_back();
    for (const std::int64_t number : numbers)
    {
      const std::int64_t* const of = ids.data() + size * std::size_t(number - mine.FirstCell);
      answers.back().insert(answers.back().end(), of, of + size);
    }
  }
  answers = ranks.allToAll(answers);
  std::vector<std::size_t> next(answers.size(), 0);
  std::int64_t* to = ids.data() + size * cells.size();
  for (const std::int64_t number : ghosts.Numbers)
  {
    const std::size_t owner = ownerOf(number, firsts);
    for (std::size_t corner = 0; corner < size; ++corner)
    {
      *to++ = answers[owner].at(next[owner]++);
    }
  }
  return ids;
}

} // namespace tipp

#endif
