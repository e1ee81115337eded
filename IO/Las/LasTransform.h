// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasTransform_h
#define tippLasTransform_h

#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <limits>

namespace tipp
{

/// How coordinates are stored: each as a whole number of 32 bits, times Scale, plus Offset.
struct LasTransform
{
  std::array<double, 3> Scale{ 1, 1, 1 };
  std::array<double, 3> Offset{};

  bool operator==(const LasTransform& other) const
  {
    return this->Scale == other.Scale && this->Offset == other.Offset;
  }
};

/// The finite coordinates of one axis: their range, and how many decimals they have.
class VTKTIPPIO_EXPORT AxisSurvey
{
public:
  void add(double coordinate);

  double low() const { return this->Low; }
  double high() const { return this->High; }
  bool isEmpty() const { return this->Low > this->High; }

  /// The scale with which 32 bits hold all coordinates as they are written in decimals; or, if they
  /// have too many decimals, the finest power of ten with which 32 bits hold the range.
  double scale() const;
  /// Whether coordinates have more decimals than that.
  bool isRounded() const;

  /// Returns an offset with which 32 bits hold the range at a scale: `wanted` if that suffices,
  /// else a whole number if possible. `isMultiple`: the multiple of the scale next to that.
  double offset(double scale, double wanted, bool isMultiple) const;
  /// Whether 32 bits hold the range.
  bool fits(double scale, double offset) const;
  /// Returns the finest power of ten with which 32 bits hold the range.
  double finestScale() const;

private:
  static constexpr int mostPlaces = 12;

  double Low = std::numeric_limits<double>::infinity();
  double High = -std::numeric_limits<double>::infinity();
  int Places = 0; ///< mostPlaces + 1: more
};

} // namespace tipp

#endif
