// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFiniteBounds_h
#define tippFiniteBounds_h

#include <array>

class vtkPoints;

namespace tipp
{

/// The bounding box of the points whose three coordinates are finite; a single NaN or infinity
/// must not decide how large a tolerance or a bounding circle is. All zero without such points.
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
