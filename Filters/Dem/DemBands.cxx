// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/DemBands.h"

#include "Points/PointTable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace tipp
{
namespace
{

constexpr const char* elevation = "elevation";

const std::map<std::string, DemBand::Kind>& derivedKinds()
{
  static const std::map<std::string, DemBand::Kind> kinds = { { "slope", DemBand::Kind::Slope },
    { "aspect", DemBand::Kind::Aspect }, { "hillshade", DemBand::Kind::Hillshade },
    { "density", DemBand::Kind::Density }, { "void", DemBand::Kind::Void } };
  return kinds;
}

bool needsElevation(DemBand::Kind kind)
{
  return kind == DemBand::Kind::Slope || kind == DemBand::Kind::Aspect ||
    kind == DemBand::Kind::Hillshade;
}

double degrees(double radians)
{
  constexpr double pi = 3.14159265358979323846;
  return radians * (180 / pi);
}

std::size_t find(const std::vector<std::string>& columns, const std::string& name)
{
  return std::size_t(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

[[noreturn]] void failToFind(const std::string& name, const std::vector<std::string>& columns)
{
  std::string list;
  for (const std::string& column : columns)
  {
    list += (list.empty() ? "" : ", ") + column;
  }
  throw UnknownBand("the points have no column '" + name + "'" +
    (list.empty() ? "." : "; of those asked for they have " + list + "."));
}

/// The slopes along x and y of the plane through three points.
struct Gradient
{
  explicit Gradient(std::array<std::array<double, 3>, 3> corners)
  {
    // Sorted, so that rounding does not depend on the order of the corners.
    std::sort(corners.begin(), corners.end());
    const auto& [a, b, c] = corners;
    const double bx = b[0] - a[0];
    const double by = b[1] - a[1];
    const double bz = b[2] - a[2];
    const double cx = c[0] - a[0];
    const double cy = c[1] - a[1];
    const double cz = c[2] - a[2];
    const double area = bx * cy - by * cx;
    this->X = (bz * cy - by * cz) / area;
    this->Y = (bx * cz - bz * cx) / area;
    this->TwiceArea = std::fabs(area);
  }

  double X;
  double Y;
  double TwiceArea;
};

double shade(const Gradient& gradient)
{
  // The direction towards the light: north-west, 45 degrees high.
  constexpr double x = -0.5;
  constexpr double y = 0.5;
  constexpr double z = 0.70710678118654752440;
  const double length = std::sqrt(1 + gradient.X * gradient.X + gradient.Y * gradient.Y);
  const double light = (z - gradient.X * x - gradient.Y * y) / length;
  return 1 + 254 * std::max(0.0, light);
}

} // namespace

std::vector<std::string> columnsForBands(const std::vector<std::string>& bands)
{
  std::vector<std::string> columns = { "z", "Z", elevation };
  for (const std::string& band : bands)
  {
    if (band != elevation && derivedKinds().count(band) == 0)
    {
      columns.push_back(band);
    }
  }
  return columns;
}

DemBands findBands(const std::vector<std::string>& bands, const std::vector<std::string>& columns)
{
  DemBands found;
  found.Elevation = findElevation(columns);
  found.HasElevation = found.Elevation < columns.size();
  for (const std::string& name : bands)
  {
    DemBand band;
    band.Name = name;
    const auto derived = derivedKinds().find(name);
    const bool isColumn = derived == derivedKinds().end();
    band.Is = isColumn ? DemBand::Kind::Column : derived->second;
    const bool isOfElevation = needsElevation(band.Is) || name == elevation;
    band.Column = isOfElevation ? found.Elevation : find(columns, name);
    if ((isColumn || isOfElevation) && band.Column >= columns.size())
    {
      failToFind(isOfElevation ? "z" : name, columns);
    }
    found.Bands.push_back(band);
  }
  return found;
}

std::vector<std::string> DemBands::names() const
{
  std::vector<std::string> names;
  for (const DemBand& band : this->Bands)
  {
    names.push_back(band.Name);
  }
  return names;
}

void fillVoids(const DemBands& bands, std::vector<std::vector<double>>& values)
{
  for (std::size_t i = 0; i < bands.Bands.size(); ++i)
  {
    if (bands.Bands[i].Is == DemBand::Kind::Void)
    {
      std::replace_if(
        values[i].begin(), values[i].end(), [](double value) { return std::isnan(value); }, 1.0);
    }
  }
}

double derivedValue(DemBand::Kind kind, const std::array<std::array<double, 3>, 3>& corners)
{
  const Gradient gradient(corners);
  switch (kind)
  {
    case DemBand::Kind::Void:
      return 0;
    case DemBand::Kind::Density:
      return 1 / gradient.TwiceArea;
    case DemBand::Kind::Slope:
      return degrees(std::atan(std::hypot(gradient.X, gradient.Y)));
    case DemBand::Kind::Aspect:
    {
      const double angle = degrees(std::atan2(-gradient.X, -gradient.Y));
      const bool isFlat = gradient.X == 0 && gradient.Y == 0;
      return isFlat ? std::numeric_limits<double>::quiet_NaN() : angle < 0 ? angle + 360 : angle;
    }
    default:
      return shade(gradient);
  }
}

} // namespace tipp
