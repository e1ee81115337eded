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

} // namespace

std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, const std::vector<Touch>& touches)
{
  struct Candidate
  {
    std::int64_t Sample;
    CellKey Key;
    std::int32_t Cell;
  };
  std::vector<Candidate> candidates;
  withAccess(mesh,
    [&](const auto& access)
    {
      for (const Touch& touch : touches)
      {
        const CellKey key = keyOf(access, touch.Cell);
        candidates.push_back(
          { touch.Sample, withRank(key, rankOf(access, axes, touch)), touch.Cell });
      }
    });
  std::sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b)
    { return std::tie(a.Sample, a.Key, a.Cell) < std::tie(b.Sample, b.Key, b.Cell); });
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
