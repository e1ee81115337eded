// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFiniteBounds_h
#define tippFiniteBounds_h

#include <array>

class vtkPoints;

namespace tipp
{

/// The bounding box of the points whose three coordinates are finite, so that a single NaN or
/// infinity does not determine a tolerance or a bounding circle. All zero if there are no such
/// points.
struct FiniteBounds
{
  std::array<double, 3> Low{ 0, 0, 0 };
  std::array<double, 3> High{ 0, 0, 0 };

  double center(int axis) const;
  double diagonal() const;
};

FiniteBounds finiteBounds(vtkPoints* points);

} // namespace tipp

#endif
