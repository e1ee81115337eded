// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDemBands_h
#define tippDemBands_h

#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{

/// A band of a raster made of triangles.
struct DemBand
{
  enum class Kind
  {
    Column,    ///< a column of the points, linear in each triangle
    Slope,     ///< of the triangle, in degrees
    Aspect,    ///< where it descends to, in degrees from the north, clockwise; NaN where it is flat
    Hillshade, ///< 1 to 255, the light coming from the north-west at 45 degrees
    Density,   ///< points a square unit of x and y: half a point in each triangle
    Void       ///< 0; where there is no triangle 1, see fillVoids()
  };
  std::string Name;
  Kind Is = Kind::Column;
  std::size_t Column = 0; ///< of the points, for Kind::Column
};

/// The point columns that bands of these names need: "elevation" stands for z or Z or elevation,
/// and slope, aspect and hillshade need the elevation.
VTKTIPPFILTERS_EXPORT std::vector<std::string> columnsForBands(
  const std::vector<std::string>& bands);

/// A band's name is that of no column.
class VTKTIPPFILTERS_EXPORT UnknownBand : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Bands of points with these columns, and which column is the elevation. Throws UnknownBand.
struct DemBands
{
  std::vector<DemBand> Bands;
  std::size_t Elevation = 0;
  bool HasElevation = false;

  std::vector<std::string> names() const;
};
VTKTIPPFILTERS_EXPORT DemBands findBands(
  const std::vector<std::string>& bands, const std::vector<std::string>& columns);

/// Sets the values of Kind::Void where there is no triangle, which are NaN before.
void fillVoids(const DemBands& bands, std::vector<std::vector<double>>& values);

/// The value of a band that is not a column, in the triangle of these corners (x, y, z), in any
/// order.
double derivedValue(DemBand::Kind kind, const std::array<std::array<double, 3>, 3>& corners);

} // namespace tipp

#endif
