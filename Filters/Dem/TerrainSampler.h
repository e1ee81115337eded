// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTerrainSampler_h
#define tippTerrainSampler_h

#include "Raster/RasterFile.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{

struct BorderSample;
struct Lattice;
struct SimplexMesh;

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
  Kind Type = Kind::Column;
  std::size_t Column = 0; ///< for Kind::Column: index of the point column
};

/// The bands of a raster for points with certain columns, and which column is the elevation.
struct DemBands
{
  std::vector<DemBand> Bands;
  std::optional<std::size_t> Elevation; ///< index of the elevation among the columns

  std::vector<std::string> names() const;
  /// How overviews of the bands are made.
  std::vector<OverviewRule> overviews() const;
};

/// Values by band, then by pixel or sample; NaN where there is no triangle.
using BandValues = std::vector<std::vector<double>>;

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

/// Returns the bands with these names. Throws UnknownBand.
VTKTIPPFILTERS_EXPORT DemBands findBands(
  const std::vector<std::string>& bands, const std::vector<std::string>& columns);

/// Returns the elevation of a point with this z: NaN, which means none, unless it is finite.
double heightOf(double z);

/// Sets the values of Kind::Void bands to 1 where there is no triangle; they are NaN there before.
void fillVoids(const DemBands& bands, BandValues& values);

/// The columns of points, indexed by DemBand::Column. Not owned.
using TerrainColumns = std::vector<const double*>;

/// The settings of a raster: grid, bands and precision.
struct TerrainSettings
{
  RasterGrid Grid;
  DemBands Bands;
  int Threads = 1;
  bool IsSingle = false; ///< values may be rounded to 32 bits
};

/// The lattice of a grid's pixel centres, from the south-west on.
Lattice latticeOf(const RasterGrid& grid);

/// Samples all triangles of a mesh at all pixels. The mesh's points are x, y and elevation, as
/// doubles; its triangles must not overlap. Returns false if `progress` stopped it.
bool sampleTerrain(const TerrainSettings& settings, const TerrainColumns& columns,
  const SimplexMesh& mesh, const std::function<bool(double)>& progress, BandValues& samples);

/// The samples of a part of a mesh on a part of the lattice.
struct SampledPart
{
  BandValues Values;
  std::vector<unsigned char> IsInside; ///< 1 for samples that a triangle contains
  /// Samples that lie on the border of a triangle without being inside any. The triangle with the
  /// lowest key claims each, in this or another part.
  std::vector<BorderSample> Border;
};

/// Samples some triangles of a mesh, which must not overlap, in the calling thread.
SampledPart samplePart(const TerrainSettings& settings, const TerrainColumns& columns,
  const SimplexMesh& mesh, const Lattice& part);

} // namespace tipp

#endif
