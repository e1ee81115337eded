// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBorderClaims_h
#define tippBorderClaims_h

#include "Resample/CellVisitor.h"
#include "Resample/Claims.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A sample on the border of a cell that does not answer it.
struct Touch
{
  std::int64_t Sample;
  std::int32_t Cell;
};

/// Touches of samples that no cell has answered so far.
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

  /// Most samples that one cell touches another answers: call now and then.
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

/// Which of the touching cells answers each sample, by ascending sample; no other cell does.
VTKTIPPACCELERATORS_EXPORT std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, const std::vector<Touch>& touches, int threads);

} // namespace tipp

#endif
