// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFindNeighbors_h
#define tippFindNeighbors_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace tipp
{

/// The number of lists that findNeighbors() needs for this number of cells.
template <std::size_t Corners = 3>
std::size_t neighborLists(std::size_t cells)
{
  std::size_t lists = 1;
  while (lists < (Corners - 2) * cells)
  {
    lists *= 2;
  }
  return lists;
}

/// For triangles that meet edge to edge and have the same orientation, or tetrahedra that meet
/// facet to facet (Corners = 4): finds for each corner the index of the cell across the opposite
/// edge or facet, or -1. The number of corners of all cells must fit in Index.
///
/// Facets whose second cell has not been found are kept in lists, which are found by a hash of the
/// points and linked in `neighbors` itself. `newest`: memory for neighborLists() values.
template <std::size_t Corners = 3, typename Id, typename Index>
void findNeighbors(const Id* corners, std::size_t cells, Index* neighbors, Index* newest)
{
  constexpr Index none = -1;
  // A link to slot h is -2 - h, so it is neither a cell nor -1, the end of a list.
  const auto link = [](Index slot) { return Index(-2 - slot); };
  // Of a triangle: the start and the end of the edge opposite to corner h % 3.
  const auto from = [&](std::size_t h) { return corners[h % 3 == 2 ? h - 2 : h + 1]; };
  const auto to = [&](std::size_t h) { return corners[h % 3 == 0 ? h + 2 : h - 1]; };
  // The points of the opposite edge or facet, ascending.
  const auto facetOf = [&](std::size_t h)
  {
    if constexpr (Corners == 3)
    {
      const auto [low, high] = std::minmax({ from(h), to(h) });
      return std::array<Id, 2>{ low, high };
    }
    else
    {
      const Id* const v = corners + h / 4 * 4;
      const std::size_t i = h % 4;
      Id low = v[i == 0 ? 1 : 0];
      Id middle = v[i <= 1 ? 2 : 1];
      Id high = v[i == 3 ? 2 : 3];
      const auto order = [](Id& a, Id& b)
      {
        if (b < a)
        {
          std::swap(a, b);
        }
      };
      order(low, middle); // std::sort() makes the whole function take half as long again
      order(middle, high);
      order(low, middle);
      return std::array<Id, 3>{ low, middle, high };
    }
  };
  const std::size_t lists = neighborLists<Corners>(cells);
  std::fill(newest, newest + lists, none);
  for (std::size_t h = 0; h < Corners * cells; ++h)
  {
    const auto facet = facetOf(h);
    const auto isSame = [&](std::size_t other)
    {
      if constexpr (Corners == 3)
      {
        return from(other) == to(h) && to(other) == from(h);
      }
      else
      {
        return facetOf(other) == facet;
      }
    };
    // Nearby points have nearby hashes, and the many facets of one point are spread.
    std::size_t hash = 0;
    for (std::size_t i = facet.size(); i-- > 0;)
    {
      hash = 5 * hash + std::size_t(facet[i]);
    }
    Index& first = newest[hash & (lists - 1)];
    Index* at = &first;
    while (*at != none && !isSame(std::size_t(link(*at))))
    {
      at = &neighbors[std::size_t(link(*at))];
    }
    if (*at == none)
    {
      neighbors[h] = first;
      first = link(Index(h));
      continue;
    }
    const Index other = link(*at);
    *at = neighbors[std::size_t(other)];
    neighbors[h] = other / Index(Corners);
    neighbors[std::size_t(other)] = Index(h / Corners);
  }
  std::transform(
    neighbors, neighbors + Corners * cells, neighbors, [=](Index n) { return std::max(n, none); });
}

/// The same with memory of its own.
template <std::size_t Corners = 3, typename Id, typename Index>
void findNeighbors(const Id* corners, std::size_t cells, Index* neighbors)
{
  std::vector<Index> newest(neighborLists<Corners>(cells));
  findNeighbors<Corners>(corners, cells, neighbors, newest.data());
}

} // namespace tipp

#endif
