// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBorderClaims_h
#define tippBorderClaims_h

#include "Resample/CellVisitor.h"
#include "Resample/Claims.h"
#include "Resample/Containment.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A sample on the border of a cell that does not claim it.
struct Touch
{
  std::int64_t Sample;
  std::int32_t Cell;

  bool operator<(const Touch& other) const
  {
    return this->Sample != other.Sample ? this->Sample < other.Sample : this->Cell < other.Cell;
  }
};

/// Touches of samples that no cell has claimed so far.
class TouchList
{
public:
  template <typename IsClaimed>
  void add(
    const SampleRow& row, int begin, int count, std::int32_t cell, const IsClaimed& isClaimed)
  {
    for (std::int64_t i = row.First + begin; i < row.First + begin + count; ++i)
    {
      if (!isClaimed(i))
      {
        this->Touches.push_back({ i, cell });
      }
    }
  }

  /// Removes the touches of samples that another cell has claimed; call now and then.
  template <typename IsClaimed>
  void tidy(const IsClaimed& isClaimed)
  {
    if (this->Touches.size() > this->Most)
    {
      this->dropClaimed(isClaimed);
      this->Most = std::max(this->Most, 2 * this->Touches.size());
    }
  }

  template <typename IsClaimed>
  void dropClaimed(const IsClaimed& isClaimed)
  {
    this->Touches.erase(std::remove_if(this->Touches.begin(), this->Touches.end(),
                          [&](const Touch& touch) { return isClaimed(touch.Sample); }),
      this->Touches.end());
  }

  const std::vector<Touch>& touches() const { return this->Touches; }

private:
  std::vector<Touch> Touches;
  std::size_t Most = 1 << 16;
};

/// The moveRank() of a cell at a sample that it touches.
template <typename Access>
int borderRank(
  const Access& access, const LatticeAxes& axes, std::int64_t sample, std::int32_t cell)
{
  typename CellGeometry<Access::Dimension>::Corners corners;
  access.corners(cell, corners);
  const std::int64_t row = sample / axes.U.size();
  const double u = axes.U[int(sample % axes.U.size())];
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

/// Returns which of the touching cells claims each sample, by ascending sample; no other cell does.
VTKTIPPACCELERATORS_EXPORT std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Touch> touches, int threads);

} // namespace tipp

#endif
