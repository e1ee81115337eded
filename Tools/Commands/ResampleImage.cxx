// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/ResampleImage.h"

#include "Commands/Report.h"
#include "Dem/RasterTiles.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/RawArray.h"
#include "Npy/NpyFile.h"
#include "Raster/RasterFile.h"
#include "Sampling/SampleNames.h"
#include "Sampling/SamplingLattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace tipp
{

void requireArrays(
  const ResampleArguments& arguments, const ArrayNames& known, const std::string& except)
{
  for (const std::string& name : arguments.Arrays)
  {
    if (name != except && known.OfPoints.count(name) + known.OfCells.count(name) == 0)
    {
      std::set<std::string> all = known.OfPoints;
      all.insert(known.OfCells.begin(), known.OfCells.end());
      throw IOError(
        arguments.Input, "has no array '" + name + "'" + listOfNames(all, "; it has ") + ".");
    }
  }
}

void requireZ(const ResampleArguments& arguments, bool hasVolumes)
{
  if (hasVolumes && !arguments.BoundsHaveZ)
  {
    throw IOError(arguments.Input,
      "has cells with a volume, for which --bounds needs xmin xmax ymin ymax zmin zmax.");
  }
}

std::string reasonOf(std::string message)
{
  const std::vector<std::pair<std::string, std::string>> names = {
    { "Resampling: ", "" },
    { "turn UseInputBounds off", "give --bounds" },
    { "SamplingDimensions", "--dims" },
    { "Delta", "--delta" },
  };
  for (const auto& [property, option] : names)
  {
    const std::size_t at = message.find(property);
    if (at != std::string::npos)
    {
      message.replace(at, property.size(), option);
    }
  }
  return "cannot be resampled: " + message;
}

double nullValueOf(const ResampleArguments& arguments)
{
  const bool isNpy = arguments.OutputIs == Opener::Npy;
  return arguments.Null.value_or(isNpy ? std::numeric_limits<double>::quiet_NaN() : 0.0);
}

namespace
{

const ImageArray* find(const ImageArrays& image, const std::string& name)
{
  const auto found = std::find_if(image.OfPoints.begin(), image.OfPoints.end(),
    [&name](const ImageArray& array) { return array.Name == name; });
  return found != image.OfPoints.end() ? &*found : nullptr;
}

/// Whether values are too large for 32 bits, or whole numbers that would lose digits.
bool needs64Bits(const std::vector<double>& values, Scalar type)
{
  constexpr double mostWhole = 1 << 24;
  const bool isWhole = type != Scalar::Float32 && type != Scalar::Float64;
  return std::any_of(values.begin(), values.end(),
    [isWhole](double value)
    {
      return isWhole ? std::fabs(value) > mostWhole
                     : std::isfinite(value) && std::isinf(float(value));
    });
}

/// Returns the arrays with one component, NaN at samples that no cell contains. Sets the names of
/// the bands, and whether they have 64 bits.
BandValues bandsOf(const ImageArrays& image, RasterDescription& description)
{
  const auto* const valid = static_cast<const char*>(find(image, validMaskName)->Values);
  BandValues bands;
  for (const ImageArray& array : image.OfPoints)
  {
    if (array.Components != 1 || array.Name == validMaskName || array.Name == ghostArrayName)
    {
      continue;
    }
    description.Bands.push_back(array.Name);
    std::vector<double> values(
      std::size_t(image.Grid.samples()), std::numeric_limits<double>::quiet_NaN());
    withScalar(array.Type,
      [&](auto zero)
      {
        const auto* const samples = static_cast<const decltype(zero)*>(array.Values);
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          values[i] = valid[i] == 1 ? double(samples[i]) : values[i];
        }
      });
    description.Double = description.Double || needs64Bits(values, array.Type);
    bands.push_back(std::move(values));
  }
  return bands;
}

void writeNpy(const ResampleArguments& arguments, const ImageArrays& image, const PathState& before)
{
  const std::string& name = arguments.Arrays.front();
  const ImageArray* const array = find(image, name);
  if (!array)
  {
    throw IOError(
      arguments.Output, "was not written: the mesh has no array '" + name + "' in this range.");
  }
  const Lattice& grid = image.Grid;
  std::vector<std::int64_t> shape;
  if (grid.size(2) > 1)
  {
    shape.push_back(grid.size(2));
  }
  shape.push_back(grid.size(1));
  shape.push_back(grid.size(0));
  if (array->Components > 1)
  {
    shape.push_back(array->Components);
  }
  NpyWriter writer(arguments.Output, scalarDescr(array->Type), shape, before);
  writer.write(array->Values,
    std::size_t(grid.samples()) * std::size_t(array->Components) * scalarSize(array->Type));
  writer.close();
}

/// Writes an image of one layer. Samples are the pixels' centres, and each array becomes a band.
void writeGeoTiff(
  const ResampleArguments& arguments, const ImageArrays& image, const PathState& before)
{
  const std::string& path = arguments.Output;
  if (image.Grid.size(2) != 1)
  {
    throw IOError(path, "cannot hold several layers; give one sample along z, or use .vti.");
  }
  constexpr double usual = -9999;
  RasterDescription description;
  description.Grid = pixelsOf(image.Grid);
  const BandValues bands = bandsOf(image, description);
  if (bands.empty())
  {
    throw IOError(path, "would have no band, because the mesh has no array with one component.");
  }
  description.Crs = arguments.Crs;
  description.NoData = arguments.Null.value_or(usual);
  description.Double = description.Double || needs64Bits({ description.NoData }, Scalar::Float64);
  description.Threads = arguments.Threads;
  const auto writer = createRaster(path, description, before);
  writeTiles(*writer, description.Grid, readFrom(description.Grid, bands), {}, arguments.Threads);
  writer->close();
  warnOfHidden(writer->hidden(), description.NoData);
}

} // namespace

void writeImage(
  const ResampleArguments& arguments, const ImageArrays& image, const PathState& before)
{
  if (arguments.OutputIs == Opener::Npy)
  {
    writeNpy(arguments, image, before);
  }
  else if (arguments.OutputIs == Opener::GeoTiff)
  {
    writeGeoTiff(arguments, image, before);
  }
  else
  {
    writeVti(arguments.Output, before, image);
  }
}

void warnOfOneSample(const ResampleArguments& arguments, std::int64_t samples)
{
  const double distance = arguments.Delta.empty() ? 0 : arguments.Delta.front();
  if (const std::string warning = warningOfOneSample(samples, distance); !warning.empty())
  {
    fmt::print(stderr, "tipp: warning: {}: {}\n", arguments.Input, warning);
  }
}

void summarize(const ResampleArguments& arguments, const ResampleFigures& figures)
{
  warnOfOneSample(arguments, figures.Samples);
  fmt::print("{} of {} samples from {} cells, {:.3f} s{}, in {}\n", figures.Hits, figures.Samples,
    figures.Cells, figures.Seconds, figures.Device.empty() ? "" : " on " + figures.Device,
    arguments.Output);
}

} // namespace tipp
