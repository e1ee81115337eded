// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangles_h
#define tippTriangles_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A view of triangles in the caller's memory: three consecutive point ids each, of 32 or 64 bits.
class TrianglesView
{
public:
  TrianglesView() = default;
  TrianglesView(const std::int32_t* ids, std::size_t triangles)
    : Ids32(ids)
    , Count(triangles)
  {
  }
  TrianglesView(const std::int64_t* ids, std::size_t triangles)
    : Ids64(ids)
    , Count(triangles)
  {
  }

  std::size_t size() const { return this->Count; }

  std::int64_t id(std::size_t triangle, int corner) const
  {
    const std::size_t at = 3 * triangle + std::size_t(corner);
    // If there is a triangle, one of the two pointers is set.
    return this->Ids32 ? this->Ids32[at]
                       : this->Ids64[at]; // NOLINT(clang-analyzer-core.NullDereference)
  }

  /// The ids; null if they have the other size.
  const std::int32_t* ids32() const { return this->Ids32; }
  const std::int64_t* ids64() const { return this->Ids64; }

private:
  const std::int32_t* Ids32 = nullptr;
  const std::int64_t* Ids64 = nullptr;
  std::size_t Count = 0;
};

/// For triangles that meet edge to edge and have the same orientation: finds for each corner the
/// index of the triangle across the opposite edge, or -1. Three times the number of triangles must
/// fit in Index.
///
/// Edges whose second triangle has not been found are kept in lists, which are found by a hash of
/// the ends and linked in `neighbors` itself.
template <typename Id, typename Index>
void findNeighbors(const Id* corners, std::size_t triangles, Index* neighbors)
{
  constexpr Index none = -1;
  // A link to half-edge h is -2 - h, so it is neither a triangle nor -1, the end of a list.
  const auto link = [](Index halfEdge) { return Index(-2 - halfEdge); };
  const auto from = [&](std::size_t h) { return corners[h % 3 == 2 ? h - 2 : h + 1]; };
  const auto to = [&](std::size_t h) { return corners[h % 3 == 0 ? h + 2 : h - 1]; };
  std::size_t lists = 1;
  while (lists < triangles)
  {
    lists *= 2;
  }
  std::vector<Index> newest(lists, none);
  for (std::size_t h = 0; h < 3 * triangles; ++h)
  {
    const Id a = from(h);
    const Id b = to(h);
    // Nearby points have nearby hashes, and the many edges of one point are spread.
    constexpr std::size_t stride = 5;
    Index& first =
      newest[(std::size_t(std::min(a, b)) + stride * std::size_t(std::max(a, b))) & (lists - 1)];
    Index* at = &first;
    while (*at != none && (from(std::size_t(link(*at))) != b || to(std::size_t(link(*at))) != a))
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
    neighbors[h] = other / 3;
    neighbors[std::size_t(other)] = Index(h / 3);
  }
  std::transform(
    neighbors, neighbors + 3 * triangles, neighbors, [=](Index n) { return std::max(n, none); });
}

} // namespace tipp

#endif
