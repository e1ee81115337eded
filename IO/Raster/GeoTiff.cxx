// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TextFile.h"
#include "Files/VtkXml.h"
#include "Raster/GdalRaster.h"
#include "Raster/RasterFile.h"
#include "Raster/TiledTiff.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace tipp
{

void BandSums::add(double value)
{
  this->Least = std::min(this->Least, value);
  this->Most = std::max(this->Most, value);
  this->Count += 1;
  const double difference = value - this->Mean;
  this->Mean += difference / this->Count;
  this->Squares += difference * (value - this->Mean);
}

void BandSums::add(const BandSums& other)
{
  if (other.Count == 0)
  {
    return;
  }
  this->Least = std::min(this->Least, other.Least);
  this->Most = std::max(this->Most, other.Most);
  const double count = this->Count + other.Count;
  const double difference = other.Mean - this->Mean;
  this->Mean += difference * (other.Count / count);
  this->Squares += other.Squares + difference * difference * (this->Count * other.Count / count);
  this->Count = count;
}

namespace
{

TiffField textField(std::uint16_t tag, const std::string& text)
{
  return { tag, TiffField::Type::Text, text + '\0' };
}

/// Whether GDAL makes the file, from a plain one.
bool isConverted(const RasterDescription& description)
{
  return description.CloudOptimized ||
    !(description.Compression == "none" ||
      (description.Compression == "deflate" && canDeflateTiles()));
}

bool isDeflated(const RasterDescription& description)
{
  return !isConverted(description) && description.Compression == "deflate";
}

/// Beyond the border of the raster a tile has no data.
template <typename T>
EncodedTile::Band encodeBand(
  const RasterDescription& description, const RasterWindow& window, const double* values)
{
  constexpr auto side = std::size_t(RasterTileSize);
  const T noData = T(description.NoData);
  std::string bytes(side * side * sizeof(T), '\0');
  T* const pixels = reinterpret_cast<T*>(bytes.data());
  std::fill(pixels, pixels + side * side, noData);
  EncodedTile::Band band;
  for (std::int64_t row = 0; row < window.Rows; ++row)
  {
    const double* const from = values + row * window.Columns;
    T* const to = pixels + std::size_t(window.Rows - 1 - row) * side;
    for (std::int64_t i = 0; i < window.Columns; ++i)
    {
      if (!std::isnan(from[i]))
      {
        to[i] = T(from[i]);
        band.Sums.add(double(to[i]));
      }
    }
  }
  band.Bytes = isDeflated(description) ? deflateTile(bytes, sizeof(T)) : std::move(bytes);
  return band;
}

/// Compresses tiles in the threads that write them, and puts them into the file in order.
class GeoTiffWriter : public RasterWriter
{
public:
  GeoTiffWriter(
    const std::string& path, const RasterDescription& description, const PathState& before)
    : Path(path)
    , Description(description)
    , Pending(path, before)
    , Sums(description.Bands.size())
  {
    if (isConverted(description))
    {
      requireConversion(description, path);
      this->Plain = std::make_unique<PendingFile>(path + ".plain");
    }
    if (!description.Crs.empty())
    {
      this->Fields = geoKeysOf(description.Crs);
    }
    this->Tiff = std::make_unique<TiledTiff>((this->Plain ? *this->Plain : this->Pending).file(),
      description.Grid, description.Bands.size(), description.Double, isDeflated(description),
      description.ClassicBytes);
  }

  void write(const RasterWindow& window, const std::vector<const double*>& bands) override
  {
    this->writeEncoded(
      tileNumber(this->Description.Grid, window), encodeTile(this->Description, window, bands));
  }

  void writeEncoded(std::int64_t tile, EncodedTile encoded) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Waiting.emplace(tile, std::move(encoded));
    while (!this->Waiting.empty() && this->Waiting.begin()->first == this->Written)
    {
      const EncodedTile& next = this->Waiting.begin()->second;
      for (std::size_t band = 0; band < next.Bands.size(); ++band)
      {
        this->Tiff->append(band, next.Bands[band].Bytes);
        this->Sums[band].add(next.Bands[band].Sums);
      }
      this->Waiting.erase(this->Waiting.begin());
      ++this->Written;
    }
  }

  void close() override
  {
    this->addFields();
    this->Tiff->finish(std::move(this->Fields));
    if (this->Plain)
    {
      convertGeoTiff(
        this->Plain->temporaryPath(), this->Pending.temporaryPath(), this->Description, this->Path);
    }
    this->Pending.commit();
  }

private:
  /// Where the raster is, what its bands are called, and their statistics, as GDAL looks for them.
  void addFields()
  {
    using Type = TiffField::Type;
    const RasterGrid& grid = this->Description.Grid;
    this->Fields.push_back(
      tiffField(33550, Type::Double, std::vector<double>{ grid.Pixel[0], grid.Pixel[1], 0 }));
    this->Fields.push_back(
      tiffField(33922, Type::Double, std::vector<double>{ 0, 0, 0, grid.West, grid.north(), 0 }));
    this->Fields.push_back(textField(42112, this->metadata()));
    this->Fields.push_back(textField(42113, exactText(this->Description.NoData)));
  }

  std::string metadata() const
  {
    std::string text = "<GDALMetadata>\n";
    for (std::size_t band = 0; band < this->Sums.size(); ++band)
    {
      const auto add = [&](const char* name, const std::string& value, const char* more = "")
      {
        text += std::string("  <Item name=\"") + name + "\" sample=\"" + std::to_string(band) +
          "\"" + more + ">" + value + "</Item>\n";
      };
      add("DESCRIPTION", escapedXml(this->Description.Bands[band]), " role=\"description\"");
      const BandSums& sums = this->Sums[band];
      if (sums.Count > 0)
      {
        add("STATISTICS_MAXIMUM", exactText(sums.Most));
        add("STATISTICS_MEAN", exactText(sums.Mean));
        add("STATISTICS_MINIMUM", exactText(sums.Least));
        add("STATISTICS_STDDEV", exactText(sums.deviation()));
      }
    }
    return text + "</GDALMetadata>\n";
  }

  const std::string Path;
  const RasterDescription Description;
  PendingFile Pending;
  std::unique_ptr<PendingFile> Plain; ///< only if converted
  std::vector<TiffField> Fields;
  std::unique_ptr<TiledTiff> Tiff;
  std::mutex Mutex;                            ///< for what follows
  std::map<std::int64_t, EncodedTile> Waiting; ///< for the tiles before them
  std::int64_t Written = 0;                    ///< tiles
  std::vector<BandSums> Sums;
};

} // namespace

EncodedTile encodeTile(const RasterDescription& description, const RasterWindow& window,
  const std::vector<const double*>& bands)
{
  EncodedTile tile;
  for (const double* const band : bands)
  {
    tile.Bands.push_back(description.Double ? encodeBand<double>(description, window, band)
                                            : encodeBand<float>(description, window, band));
  }
  return tile;
}

std::unique_ptr<RasterWriter> createGeoTiff(
  const std::string& path, const RasterDescription& description, const PathState& before)
{
  return std::make_unique<GeoTiffWriter>(path, description, before);
}

} // namespace tipp
