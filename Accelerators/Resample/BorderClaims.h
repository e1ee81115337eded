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

/// The common base of the sinks that find the cells of samples: statistics, and the touches whose
/// samples no cell has claimed yet. `Walk::isClaimed(sample)` returns whether a cell has claimed a
/// sample.
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

  void touch(const SampleRow& row, int begin, int count, std::int32_t cell)
  {
    for (std::int64_t i = row.First + begin; i < row.First + begin + count; ++i)
    {
      if (!this->isClaimed(i))
      {
        this->Touches.push_back({ i, cell });
      }
    }
  }

  /// Saves memory: now and then removes the touches of samples that have been claimed meanwhile.
  void endChunk()
  {
    if (this->Touches.size() > this->MostTouches)
    {
      this->MostTouches = std::max(this->MostTouches, 2 * this->openTouches().size());
    }
  }

  /// The touches of samples that no cell has claimed.
  const std::vector<Touch>& openTouches()
  {
    this->Touches.erase(std::remove_if(this->Touches.begin(), this->Touches.end(),
                          [this](const Touch& touch) { return this->isClaimed(touch.Sample); }),
      this->Touches.end());
    return this->Touches;
  }

  ClaimStatistics Statistics;
  std::int64_t Claimed = 0; ///< number of samples, each counted for every cell that claims it

private:
  bool isClaimed(std::int64_t sample) const
  {
    return static_cast<const Walk*>(this)->isClaimed(sample);
  }

  std::vector<Touch> Touches;
  std::size_t MostTouches = 1 << 16;
};

/// Adds up what the threads' walks have found. Returns the touches of samples that no cell has
/// claimed.
template <typename Walk>
std::vector<Touch> joinWalks(
  std::vector<Walk>& walks, ClaimStatistics& statistics, std::int64_t& claimed)
{
  std::vector<Touch> touches;
  for (Walk& walk : walks)
  {
    statistics.VisitedCells += walk.Statistics.VisitedCells;
    statistics.Tests += walk.Statistics.Tests;
    statistics.ExactTests += walk.Statistics.ExactTests;
    claimed += walk.Claimed;
    const std::vector<Touch>& open = walk.openTouches();
    touches.insert(touches.end(), open.begin(), open.end());
  }
  return touches;
}

/// The moveRank() of a cell at a sample that it touches.
template <typename Access>
int borderRank(
  const Access& access, const LatticeAxes& axes, std::int64_t sample, std::int32_t cell)
{
  typename Access::Point corners[Access::Corners];
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
