// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/TerrainSampler.h"

#include "Parallel/ParallelFor.h"
#include "Resample/Interpolate.h"
#include "Resample/Resample.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tipp
{
namespace
{

constexpr double noValue = std::numeric_limits<double>::quiet_NaN();

using Corners = std::array<std::array<double, 3>, 3>;

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
    const SimplexMesh& mesh, int threads, SampledBands& samples)
  {
    const std::vector<DemBand>& bands = settings.Bands.Bands;
    this->Derived.resize(bands.size());
    for (std::size_t i = 0; i < bands.size(); ++i)
    {
      Attribute attribute;
      attribute.Samples = samples.Values[i].data();
      attribute.NullValue = noValue;
      attribute.OfCells = bands[i].Is != DemBand::Kind::Column;
      if (attribute.OfCells)
      {
        this->derive(bands[i].Is, mesh, threads, this->Derived[i]);
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
    forChunks(mesh.Cells, 1 << 12, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t cell = begin; cell < end; ++cell)
        {
          values[std::size_t(cell)] = derivedValue(kind, cornersOf(mesh, cell));
        }
      });
  }

  std::vector<std::vector<double>> Derived;
};

void allocate(const TerrainSettings& settings, std::int64_t count, SampledBands& samples)
{
  samples.Values.resize(settings.Bands.Bands.size());
  for (std::vector<double>& values : samples.Values)
  {
    values.resize(std::size_t(count));
  }
}

} // namespace

Box2 boundsOf(const double* rows, std::size_t words, std::size_t points)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box2 box{ infinity, infinity, -infinity, -infinity };
  for (std::size_t i = 0; i < points; ++i)
  {
    const Point2 p{ rows[i * words], rows[i * words + 1] };
    if (isFinite(p))
    {
      box = { std::min(box.xmin, p.x), std::min(box.ymin, p.y), std::max(box.xmax, p.x),
        std::max(box.ymax, p.y) };
    }
  }
  return box;
}

Lattice latticeOf(const RasterGrid& grid)
{
  Lattice lattice;
  lattice.Min = { grid.West + 0.5 * grid.Pixel[0], grid.South + 0.5 * grid.Pixel[1], 0 };
  lattice.Delta = { grid.Pixel[0], grid.Pixel[1], 1 };
  lattice.Extent = { 0, int(grid.Columns - 1), 0, int(grid.Rows - 1), 0, 0 };
  return lattice;
}

bool sampleTerrain(const TerrainSettings& settings, const TerrainColumns& columns,
  const SimplexMesh& mesh, const Report& progress, SampledBands& samples)
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
  allocate(settings, part.samples(), sampled.Bands);
  sampled.IsInside.resize(std::size_t(part.samples()));
  const BandArrays arrays(settings, columns, mesh, 1, sampled.Bands);
  InterpolationOptions options;
  options.Valid = sampled.IsInside.data();
  if (samplePartDirectly(mesh, part, arrays.Attributes, options, sampled.Border).Overlapping)
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
