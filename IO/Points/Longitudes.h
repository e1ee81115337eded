// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLongitudes_h
#define tippLongitudes_h

#include "vtkTIPPIOModule.h"

#include <cmath>
#include <string>
#include <vector>

namespace tipp
{

/// Moves longitudes in degrees, x of interleaved x and y, by 360 into [top - 360, top); top is 180
/// or 360, and 0 leaves them. Throws IOError if a number is no longitude.
VTKTIPPIO_EXPORT void wrapLongitudes(const std::string& path, int top, std::vector<double>& xy);

/// The extent of points that may be longitudes and latitudes in degrees, as given and with the
/// longitudes east of Greenwich and those west of it the other way round.
class VTKTIPPIO_EXPORT LongitudeSpan
{
public:
  void add(double x, double y);
  /// Adds points whose x and y are interleaved.
  void add(const std::vector<double>& xy);
  void add(const LongitudeSpan& other);

  /// A sentence for a warning if the points lie on both sides of the meridian at which their
  /// longitudes jump by 360, and are closer to each other across it; else an empty text.
  std::string warning() const;

private:
  struct LongitudeRange
  {
    double Low = HUGE_VAL;
    double High = -HUGE_VAL;

    void add(double low, double high)
    {
      this->Low = std::fmin(this->Low, low);
      this->High = std::fmax(this->High, high);
    }
  };

  LongitudeRange Given;
  LongitudeRange Turned;
  bool IsInDegrees = true;
};

} // namespace tipp

#endif
