// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/TerrainSampler.h"

#include "Parallel/ParallelFor.h"
#include "Points/ReadPoints.h"
#include "Predicates/Angles.h"
#include "Resample/Resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace tipp
{
namespace
{

constexpr const char* elevation = "elevation";
constexpr double noValue = std::numeric_limits<double>::quiet_NaN();

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
  const std::size_t heights = findElevation(columns);
  found.Elevation = heights < columns.size() ? std::make_optional(heights) : std::nullopt;
  for (const std::string& name : bands)
  {
    DemBand band;
    band.Name = name;
    const auto derived = derivedKinds().find(name);
    const bool isColumn = derived == derivedKinds().end();
    band.Type = isColumn ? DemBand::Kind::Column : derived->second;
    const bool isOfElevation = needsElevation(band.Type) || name == elevation;
    band.Column = isOfElevation ? heights : find(columns, name);
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

std::vector<OverviewRule> DemBands::overviews() const
{
  std::vector<OverviewRule> rules;
  for (const DemBand& band : this->Bands)
  {
    const bool isClass = band.Type == DemBand::Kind::Void || band.Name == "classification";
    rules.push_back(isClass                  ? OverviewRule::Nearest
        : band.Type == DemBand::Kind::Aspect ? OverviewRule::Direction
                                             : OverviewRule::Mean);
  }
  return rules;
}

double heightOf(double z)
{
  return std::isfinite(z) ? z : noValue;
}

void fillVoids(const DemBands& bands, BandValues& values)
{
  for (std::size_t i = 0; i < bands.Bands.size(); ++i)
  {
    if (bands.Bands[i].Type == DemBand::Kind::Void)
    {
      std::replace_if(
        values[i].begin(), values[i].end(), [](double value) { return std::isnan(value); }, 1.0);
    }
  }
}

namespace
{

using Corners = std::array<Point3, 3>;

/// The slopes along x and y of the plane through three points.
struct Gradient
{
  explicit Gradient(Corners corners)
  {
    // Sorted, so that rounding does not depend on the order of the corners.
    std::sort(corners.begin(), corners.end(),
      [](const Point3& p, const Point3& q) { return lexicographicLess(p, q); });
    const Point3 b = corners[1] - corners[0];
    const Point3 c = corners[2] - corners[0];
    const double area = b.x * c.y - b.y * c.x;
    this->X = (b.z * c.y - b.y * c.z) / area;
    this->Y = (b.x * c.z - b.z * c.x) / area;
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
  return 1 + 254 * (light < 0 ? 0 : light); // NaN stays NaN
}

/// The value of a derived band (not a column) in a triangle.
double derivedValue(DemBand::Kind kind, const Corners& corners)
{
  const Gradient gradient(corners);
  switch (kind)
  {
    case DemBand::Kind::Void:
      return 0;
    case DemBand::Kind::Density:
      return 1 / gradient.TwiceArea;
    case DemBand::Kind::Slope:
      return degreesOf(1, std::sqrt(gradient.X * gradient.X + gradient.Y * gradient.Y));
    case DemBand::Kind::Aspect:
    {
      const double angle = degreesOf(-gradient.Y, -gradient.X);
      const bool isFlat = gradient.X == 0 && gradient.Y == 0;
      const double turned = angle < 0 ? angle + 360 : angle;
      return isFlat ? noValue : turned < 360 ? turned : 0;
    }
    default:
      return shade(gradient);
  }
}

Corners cornersOf(const SimplexMesh& mesh, std::int64_t triangle)
{
  Corners corners;
  const auto* const points = static_cast<const double*>(mesh.Points);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::int64_t at = 3 * triangle + std::int64_t(i);
    const std::int64_t id = mesh.Wide ? static_cast<const std::int64_t*>(mesh.Ids)[at]
                                      : static_cast<const std::int32_t*>(mesh.Ids)[at];
    corners[i] = { points[3 * id], points[3 * id + 1], points[3 * id + 2] };
  }
  return corners;
}

/// The arrays to sample, including bands derived from the triangles.
class BandArrays
{
public:
  BandArrays(const TerrainSettings& settings, const TerrainColumns& columns,
    const SimplexMesh& mesh, int threads, BandValues& samples)
  {
    const std::vector<DemBand>& bands = settings.Bands.Bands;
    this->Derived.resize(bands.size());
    for (std::size_t i = 0; i < bands.size(); ++i)
    {
      Attribute attribute;
      attribute.Samples = samples[i].data();
      attribute.NullValue = noValue;
      attribute.OfCells = bands[i].Type != DemBand::Kind::Column;
      if (attribute.OfCells)
      {
        this->derive(bands[i].Type, mesh, threads, this->Derived[i]);
      }
      attribute.Values = attribute.OfCells ? this->Derived[i].data() : columns[bands[i].Column];
      this->Attributes.push_back(attribute);
    }
  }

  std::vector<Attribute> Attributes;

private:
  static void derive(
    DemBand::Kind kind, const SimplexMesh& mesh, int threads, std::vector<double>& values)
  {
    values.resize(std::size_t(mesh.Cells));
    forIndices(
      mesh.Cells,
      [&](std::int64_t cell)
      { values[std::size_t(cell)] = derivedValue(kind, cornersOf(mesh, cell)); },
      threads, 1 << 12);
  }

  std::vector<std::vector<double>> Derived; ///< by band, then by triangle; empty for columns
};

void allocate(const TerrainSettings& settings, std::int64_t count, BandValues& samples)
{
  samples.resize(settings.Bands.Bands.size());
  for (std::vector<double>& values : samples)
  {
    values.resize(std::size_t(count));
  }
}

} // namespace

Lattice latticeOf(const RasterGrid& grid)
{
  Lattice lattice;
  const Point2 first = grid.firstCentre();
  lattice.Min = { first.x, first.y, 0 };
  lattice.Delta = { grid.Pixel[0], grid.Pixel[1], 1 };
  lattice.Extent = { 0, int(grid.Columns - 1), 0, int(grid.Rows - 1), 0, 0 };
  lattice.Slack = { roundingOf(grid.West, gridPosition(grid.West, grid.Pixel[0], 2 * grid.Columns)),
    roundingOf(grid.South, grid.north()), 0 };
  return lattice;
}

bool sampleTerrain(const TerrainSettings& settings, const TerrainColumns& columns,
  const SimplexMesh& mesh, const Report& progress, BandValues& samples)
{
  if (mesh.Cells > std::numeric_limits<std::int32_t>::max())
  {
    throw std::runtime_error("there are " + std::to_string(mesh.Cells) +
      " triangles, and 2147483647 can be sampled in memory: give --memory.");
  }
  allocate(settings, settings.Grid.pixels(), samples);
  const BandArrays arrays(settings, columns, mesh, settings.Threads, samples);
  std::vector<unsigned char> valid(std::size_t(settings.Grid.pixels()), 0);
  ResampleOptions options;
  options.Threads = settings.Threads;
  options.Valid = valid.data();
  options.Progress = progress;
  return !resample(mesh, latticeOf(settings.Grid), arrays.Attributes, options).Aborted;
}

SampledPart samplePart(const TerrainSettings& settings, const TerrainColumns& columns,
  const SimplexMesh& mesh, const Lattice& part)
{
  SampledPart sampled;
  allocate(settings, part.samples(), sampled.Values);
  sampled.IsInside.resize(std::size_t(part.samples()));
  const BandArrays arrays(settings, columns, mesh, 1, sampled.Values);
  ResampleOptions options;
  options.Valid = sampled.IsInside.data();
  if (sampleDirectly(mesh, part, arrays.Attributes, options, &sampled.Border).Overlapping)
  {
    throw std::logic_error("triangles of a triangulation overlap");
  }
  for (const BorderSample& sample : sampled.Border)
  {
    sampled.IsInside[std::size_t(sample.Sample)] = 0;
  }
  return sampled;
}

} // namespace tipp
