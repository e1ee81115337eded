// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTerrainSampler_h
#define tippTerrainSampler_h

#include "Dem/DemBands.h"
#include "Predicates/Points.h"
#include "Raster/RasterFile.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

struct BorderSample;
struct Lattice;
struct SimplexMesh;

/// The columns of points, indexed by DemBand::Column. Not owned.
using TerrainColumns = std::vector<const double*>;

/// The bounding box of the points with finite x and y; xmin > xmax if there are none. `rows` holds
/// `words` numbers per point, x and y first.
Box2 boundsOf(const double* rows, std::size_t words, std::size_t points);

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

/// The values at pixels, NaN where there is no triangle.
struct SampledBands
{
  std::vector<std::vector<double>> Values; ///< values by band, then by sample
};

/// Samples all triangles of a mesh at all pixels. The mesh's points are x, y and elevation, as
/// doubles; its triangles must not overlap. Returns false if `progress` stopped it.
bool sampleTerrain(const TerrainSettings& settings, const TerrainColumns& columns,
  const SimplexMesh& mesh, const std::function<bool(double)>& progress, SampledBands& samples);

/// The samples of a part of a mesh on a part of the lattice.
struct SampledPart
{
  SampledBands Bands;
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
