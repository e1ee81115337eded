// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/BorderClaims.h"

#include "Resample/CellKey.h"

#include <utility>

namespace tipp
{
namespace
{

/// Each thread sorts a part, then the parts are merged.
void sort(std::vector<Touch>& touches, int threads)
{
  const auto border = [&](std::int64_t share)
  { return touches.begin() + std::ptrdiff_t(touches.size()) * share / threads; };
  forChunks(threads, 1, threads, {},
    [&](std::int64_t begin, std::int64_t end, int) { std::sort(border(begin), border(end)); });
  for (std::int64_t share = 1; share < threads; ++share)
  {
    std::inplace_merge(touches.begin(), border(share), border(share + 1));
  }
}

/// Of the cells that touch a sample, the one of lowest key.
template <typename Access>
std::int32_t lowestCell(
  const Access& cells, const LatticeAxes& axes, const Touch* begin, const Touch* end)
{
  std::pair<CellKey, std::int32_t> lowest(noCellKey, begin->Cell);
  // Most samples are touched by one cell only.
  for (const Touch* touch = begin; end - begin > 1 && touch < end; ++touch)
  {
    const int rank = borderRank(cells, axes, touch->Sample, touch->Cell);
    lowest = std::min(lowest, { withRank(keyOf(cells, touch->Cell), rank), touch->Cell });
  }
  return lowest.second;
}

} // namespace

std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Touch> touches, int threads)
{
  sort(touches, threads);
  std::vector<BorderClaim> claims;
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < touches.size(); ++i)
  {
    if (i == 0 || touches[i].Sample != touches[i - 1].Sample)
    {
      claims.push_back({ touches[i].Sample, touches[i].Cell });
      begins.push_back(i);
    }
  }
  begins.push_back(touches.size());
  withAccess(mesh,
    [&](const auto& access)
    {
      forChunks(std::int64_t(claims.size()), 1 << 8, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        {
          for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
          {
            claims[i].Cell =
              lowestCell(access, axes, touches.data() + begins[i], touches.data() + begins[i + 1]);
          }
        });
    });
  return claims;
}

} // namespace tipp
