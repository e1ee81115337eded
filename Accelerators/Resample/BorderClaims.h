// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBorderClaims_h
#define tippBorderClaims_h

#include "Predicates/Points.h"
#include "Resample/CellVisitor.h"
#include "Resample/Claims.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tipp
{

/// moveRank() of a cell that contains a sample is the lowest rank of a symbolic move that takes the
/// sample into the cell's interior. Rank 0 is the move by (e, e^2, e^3) with infinitesimal e. Rank
/// m is that move mirrored along x if bit 0 of m is set, along y if bit 1, and along z if bit 2.
/// `closedOnly` means that no move does. Among the cells at a sample, the one of lowest rank claims
/// it.
constexpr int closedOnly = 8;

/// Exact. The corners are in any order; the triangle has an area and contains the sample.
int moveRank(const Point2 (&corners)[3], Point2 sample);
/// Exact. The corners are in any order; the tetrahedron has a volume and contains the sample.
int moveRank(const Point3 (&corners)[4], Point3 sample);

/// A sample on the border of a cell that does not claim it.
struct Touch
{
  std::int64_t Sample; ///< index of the sample
  std::int32_t Cell;   ///< index of the cell

  bool operator<(const Touch& other) const
  {
    return this->Sample != other.Sample ? this->Sample < other.Sample : this->Cell < other.Cell;
  }
};

/// The touches whose samples no cell has claimed yet.
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

  /// Removes the touches of samples that have been claimed meanwhile; call it now and then to save
  /// memory.
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

/// The common base of the sinks that find the cells of samples: statistics, and the touches.
/// `Walk::isClaimed(sample)` returns whether a cell has claimed a sample.
template <typename Walk>
class TouchingWalk
{
public:
  void visit(std::int64_t samples)
  {
    ++this->Statistics.VisitedCells;
    this->Statistics.Tests += samples;
  }
  void addExactTests(std::int64_t count) { this->Statistics.ExactTests += count; }

  /// The touches of samples that no cell has claimed.
  const std::vector<Touch>& openTouches()
  {
    this->Touches.dropClaimed(this->claimed());
    return this->Touches.touches();
  }

  ClaimStatistics Statistics;
  std::int64_t Claimed = 0;

protected:
  auto claimed() const
  {
    return [walk = static_cast<const Walk*>(this)](std::int64_t sample)
    { return walk->isClaimed(sample); };
  }

  TouchList Touches;
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

/// Decides which of the touching cells claims each sample; no other cell claims it. Returns the
/// claims by ascending sample.
VTKTIPPACCELERATORS_EXPORT std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Touch> touches, int threads);

} // namespace tipp

#endif
