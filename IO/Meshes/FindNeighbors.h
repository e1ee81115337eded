// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFindNeighbors_h
#define tippFindNeighbors_h

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tipp
{

/// For triangles that meet edge to edge and have the same orientation: finds for each corner the
/// index of the triangle across the opposite edge, or -1. Three times the number of triangles must
/// fit in Place.
///
/// Edges whose second triangle has not been found are kept in lists, which are found by a hash of
/// the ends and linked in `neighbors` itself.
template <typename Id, typename Place>
void findNeighbors(const Id* corners, std::size_t triangles, Place* neighbors)
{
  constexpr Place none = -1;
  // A link to half-edge h is -2 - h, so it is neither a triangle nor -1, the end of a list.
  const auto link = [](Place halfEdge) { return Place(-2 - halfEdge); };
  const auto from = [&](std::size_t h) { return corners[h % 3 == 2 ? h - 2 : h + 1]; };
  const auto to = [&](std::size_t h) { return corners[h % 3 == 0 ? h + 2 : h - 1]; };
  std::size_t lists = 1;
  while (lists < triangles)
  {
    lists *= 2;
  }
  std::vector<Place> newest(lists, none);
  for (std::size_t h = 0; h < 3 * triangles; ++h)
  {
    const Id a = from(h);
    const Id b = to(h);
    // Nearby points have nearby hashes, and the many edges of one point are spread.
    constexpr std::size_t stride = 5;
    Place& first =
      newest[(std::size_t(std::min(a, b)) + stride * std::size_t(std::max(a, b))) & (lists - 1)];
    Place* at = &first;
    while (*at != none && (from(std::size_t(link(*at))) != b || to(std::size_t(link(*at))) != a))
    {
      at = &neighbors[std::size_t(link(*at))];
    }
    if (*at == none)
    {
      neighbors[h] = first;
      first = link(Place(h));
      continue;
    }
    const Place other = link(*at);
    *at = neighbors[std::size_t(other)];
    neighbors[h] = other / 3;
    neighbors[std::size_t(other)] = Place(h / 3);
  }
  std::transform(
    neighbors, neighbors + 3 * triangles, neighbors, [=](Place n) { return std::max(n, none); });
}

} // namespace tipp

#endif
