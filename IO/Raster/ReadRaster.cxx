// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/ReadRaster.h"

#include "Crs/TiffDirectory.h"
#include "Files/Formats.h"
#include "Files/IOError.h"

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>
#include <vector>

namespace tipp
{
namespace
{

/// The six numbers of a transform in GDAL's order: x of the origin, width, 0, y of the origin, 0,
/// negative height.
using Transform = std::array<double, 6>;

std::optional<Transform> transformOf(const TiffDirectory& directory)
{
  // OGC 19-008r4, annex B.6: a scale and a tie point, or a matrix.
  const std::vector<double> scale = directory.numbers(33550);
  const std::vector<double> tie = directory.numbers(33922);
  const std::vector<double> matrix = directory.numbers(34264);
  if (scale.size() >= 2 && tie.size() >= 6)
  {
    return Transform{ tie[3] - tie[0] * scale[0], scale[0], 0, tie[4] + tie[1] * scale[1], 0,
      -scale[1] };
  }
  return matrix.size() >= 16 ? std::make_optional(Transform{
                                 matrix[3], matrix[0], matrix[1], matrix[7], matrix[4], matrix[5] })
                             : std::nullopt;
}

/// Whether the transform is that of pixels' centres (GTRasterTypeGeoKey).
bool isOfCentres(const std::string& keys)
{
  for (std::size_t at = 8; at + 8 <= keys.size(); at += 8)
  {
    std::array<std::uint16_t, 4> key{};
    std::memcpy(key.data(), keys.data() + at, sizeof key);
    if (key[0] == 1025 && key[1] == 0)
    {
      return key[3] == 2;
    }
  }
  return false;
}

std::int64_t countOf(const TiffDirectory& directory, std::uint16_t tag, const std::string& path)
{
  const std::vector<double> values = directory.numbers(tag);
  const double most = std::numeric_limits<std::int32_t>::max();
  if (values.size() != 1 || !(values[0] >= 1 && values[0] <= most))
  {
    throw IOError(path, "gives no number of rows or of columns; copy or write it again.");
  }
  return std::int64_t(values[0]);
}

} // namespace

void refuseGrid(const std::string& path)
{
  throw IOError(path, "is no raster whose rows run from west to east and from north to south.");
}

std::optional<RasterInfo> readGeoTiffInfo(const std::string& path)
{
  const TiffDirectory directory = TiffDirectory::ofFile(path);
  RasterInfo info;
  RasterGrid& grid = info.Grid;
  grid.Columns = countOf(directory, 256, path);
  grid.Rows = countOf(directory, 257, path);
  const CrsRecords records{ "", directory.field(34735).Bytes, directory.field(34736).Bytes,
    directory.field(34737).Bytes };
  const std::optional<Transform> transform = transformOf(directory);
  if (!transform)
  {
    return std::nullopt;
  }
  auto [west, width, a, north, b, height] = *transform;
  if (a != 0 || b != 0 || !(width > 0) || !(height < 0) || !std::isfinite(width) ||
    !std::isfinite(height) || !std::isfinite(west) || !std::isfinite(north))
  {
    refuseGrid(path);
  }
  if (isOfCentres(records.Keys))
  {
    west -= width / 2;
    north -= height / 2;
  }
  grid.Pixel = { width, -height };
  grid.West = west;
  grid.South = gridPosition(north, height, 2 * grid.Rows);
  grid.North = north;
  info.Crs = understandCrs(records);
  return info;
}

RasterInfo readRasterInfo(const std::string& path)
{
  const std::optional<RasterInfo> info =
    openerOf(path, Use::Rasters) == Opener::GeoTiff ? readGeoTiffInfo(path) : std::nullopt;
#ifdef TIPP_HAVE_GDAL
  // GDAL also reads the files beside a TIFF, which may state another grid or the reference system.
  std::error_code ignored;
  const bool isAlone = !std::filesystem::exists(path + ".aux.xml", ignored);
  return info && isAlone && !info->Crs.Text.empty() ? *info : readWithGdal(path);
#else
  return info ? *info : readWithGdal(path);
#endif
}

} // namespace tipp
