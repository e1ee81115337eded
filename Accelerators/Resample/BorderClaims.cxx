// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/BorderClaims.h"

#include "Resample/CellKey.h"
#include "Resample/Containment.h"

#include <tuple>

namespace tipp
{
namespace
{

template <typename Access>
int rankOf(const Access& access, const LatticeAxes& axes, const Touch& touch)
{
  typename CellGeometry<Access::Dimension>::Corners corners;
  access.corners(touch.Cell, corners);
  const std::int64_t row = touch.Sample / axes.U.size();
  const double u = axes.U[int(touch.Sample % axes.U.size())];
  const double v = axes.V[int(row % axes.V.size())];
  if constexpr (Access::Dimension == 2)
  {
    return moveRank(corners, { u, v });
  }
  else
  {
    return moveRank(corners, { u, v, axes.W[int(row / axes.V.size())] });
  }
}

struct Candidate
{
  std::int64_t Sample;
  CellKey Key;
  std::int32_t Cell;
};

bool operator<(const Candidate& a, const Candidate& b)
{
  return std::tie(a.Sample, a.Key, a.Cell) < std::tie(b.Sample, b.Key, b.Cell);
}

/// Each thread sorts a share of them, and then the shares are merged.
void sort(std::vector<Candidate>& candidates, int threads)
{
  const auto border = [&](std::int64_t share)
  { return candidates.begin() + std::ptrdiff_t(candidates.size()) * share / threads; };
  forChunks(threads, 1, threads, {},
    [&](std::int64_t begin, std::int64_t end, int) { std::sort(border(begin), border(end)); });
  for (std::int64_t share = 1; share < threads; ++share)
  {
    std::inplace_merge(candidates.begin(), border(share), border(share + 1));
  }
}

} // namespace

std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, const std::vector<Touch>& touches, int threads)
{
  std::vector<Candidate> candidates(touches.size());
  withAccess(mesh,
    [&](const auto& access)
    {
      forChunks(std::int64_t(touches.size()), 1 << 12, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        {
          for (std::int64_t i = begin; i < end; ++i)
          {
            const Touch& touch = touches[std::size_t(i)];
            const CellKey key = withRank(keyOf(access, touch.Cell), rankOf(access, axes, touch));
            candidates[std::size_t(i)] = { touch.Sample, key, touch.Cell };
          }
        });
    });
  sort(candidates, threads);
  std::vector<BorderClaim> claims;
  for (const Candidate& candidate : candidates)
  {
    if (claims.empty() || claims.back().Sample != candidate.Sample)
    {
      claims.push_back({ candidate.Sample, candidate.Cell, int(candidate.Key >> 60) });
    }
  }
  return claims;
}

} // namespace tipp
