// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleBoxes_h
#define tippSampleBoxes_h

#include "Predicates/Geometry.h"
#include "Resample/Lattice.h"

#include <algorithm>
#include <cmath>

namespace tipp
{

/// Finds out by a triangle's bounding box whether it may claim a sample of a lattice in the plane.
class SampleBoxes
{
public:
  explicit SampleBoxes(const Lattice& lattice)
    : U(lattice, 0)
    , V(lattice, 1)
  {
  }

  /// False only if no sample is in the box or as near to it as Lattice::Slack permits.
  bool mayHoldSamples(const Box2& box) const
  {
    // A sample within the slack of an edge along one axis may be off along the other one, too, by
    // as much as the slope of the edge in steps, which is at most 1.
    const double u = std::max(this->U.Slack, roundingOf(box.Min.x, box.Max.x));
    const double v = std::max(this->V.Slack, roundingOf(box.Min.y, box.Max.y));
    return holds(this->U, box.Min.x, box.Max.x,
             2 * (u + v * std::fabs(this->U.Delta / this->V.Delta))) &&
      holds(this->V, box.Min.y, box.Max.y, 2 * (v + u * std::fabs(this->V.Delta / this->U.Delta)));
  }

private:
  static bool holds(const LatticeAxis& axis, double low, double high, double margin)
  {
    const double error = axis.error(std::max(std::fabs(low), std::fabs(high)) + margin);
    if (!(error < 0.5) || !std::isfinite(margin))
    {
      return true;
    }
    // The first sample is at position 1.
    return std::ceil(axis.position(low - margin) - error) <=
      std::floor(axis.position(high + margin) + error);
  }

  LatticeAxis U;
  LatticeAxis V;
};

} // namespace tipp

#endif
