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

/// A band of a raster that is sampled from triangles.
struct DemBand
{
  enum class Kind
  {
    Column,    ///< a column of the points, linear in each triangle
    Slope,     ///< slope of the triangle, in degrees
    Aspect,    ///< direction of descent, in degrees clockwise from north; NaN for flat triangles
    Hillshade, ///< 1 to 255, with light from the north-west at 45 degrees
    Density,   ///< points per square unit of x and y, counting half a point per triangle
    Void       ///< 0 in triangles, 1 elsewhere; see fillVoids()
  };
  std::string Name;
  Kind Is = Kind::Column;
  std::size_t Column = 0; ///< for Kind::Column: index of the point column
};

/// The names of the point columns that bands with these names need. "elevation" stands for z, Z or
/// elevation; slope, aspect and hillshade need the elevation.
VTKTIPPFILTERS_EXPORT std::vector<std::string> columnsForBands(
  const std::vector<std::string>& bands);

/// Thrown if a band's name is neither a derived band nor a column.
class VTKTIPPFILTERS_EXPORT UnknownBand : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The bands of a raster for points with certain columns, and which column is the elevation. The
/// constructor throws UnknownBand.
struct DemBands
{
  std::vector<DemBand> Bands;
  std::size_t Elevation = 0; ///< index of the elevation among the columns, if HasElevation
  bool HasElevation = false;

  std::vector<std::string> names() const;
};
VTKTIPPFILTERS_EXPORT DemBands findBands(
  const std::vector<std::string>& bands, const std::vector<std::string>& columns);

/// Sets the values of Kind::Void bands to 1 where there is no triangle; they are NaN there before.
void fillVoids(const DemBands& bands, std::vector<std::vector<double>>& values);

/// The value of a derived band (not a column) in a triangle with these corners (x, y, z), in any
/// order.
double derivedValue(DemBand::Kind kind, const std::array<std::array<double, 3>, 3>& corners);

} // namespace tipp

#endif
