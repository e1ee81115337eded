// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTerrainSampler_h
#define tippTerrainSampler_h

#include "Dem/DemBands.h"
#include "Raster/RasterFile.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

struct BorderSample;
struct Lattice;
struct SimplexMesh;

/// Points of triangles that are sampled.
struct TerrainPoints
{
  const double* XYZ = nullptr; ///< x, y and elevation in turn
  std::int64_t Count = 0;
  std::vector<const double*> Columns; ///< as DemBand::Column counts them
};

struct TerrainSettings
{
  RasterGrid Grid;
  DemBands Bands;
  int Threads = 1;
  bool IsSingle = false; ///< 32 bits of each value are enough
};

/// The centres of a grid's pixels as samples, from the south-west on.
Lattice latticeOf(const RasterGrid& grid);

/// Values at pixels, NaN where there is none.
struct SampledBands
{
  std::vector<std::vector<double>> Values; ///< of each band, by sample
};

/// Samples all triangles of a mesh, which do not overlap, at all pixels. `ids`: three a triangle,
/// of 32 or 64 bits. False if `progress` ended it.
bool sampleTerrain(const TerrainSettings& settings, const TerrainPoints& points,
  const SimplexMesh& mesh, const std::function<bool(double)>& progress, SampledBands& samples);

/// A part of a mesh at the pixels of a part of the lattice.
struct SampledPart
{
  SampledBands Bands;
  std::vector<unsigned char> IsInside; ///< 1 for samples that a triangle contains
  /// Samples that none contains but that lie on the border of a triangle. The one of the lowest key
  /// answers, here or in another part.
  std::vector<BorderSample> Border;
};

/// Samples some triangles of a mesh, which do not overlap, in the calling thread.
SampledPart samplePart(const TerrainSettings& settings, const TerrainPoints& points,
  const SimplexMesh& mesh, const Lattice& part);

} // namespace tipp

#endif
