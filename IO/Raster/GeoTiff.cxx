// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/RasterFile.h"

#include "Files/IOError.h"
#include "Raster/GdalLibrary.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>

namespace tipp
{
namespace
{

/// Fails with what GDAL says.
[[noreturn]] void fail(const std::string& path, const std::string& what)
{
  std::string reason = gdal().CPLGetLastErrorMsg();
  reason = reason.substr(0, reason.find('\n'));
  while (!reason.empty() && reason.back() == '.')
  {
    reason.pop_back();
  }
  throw IOError(path, what + (reason.empty() ? "." : " (" + reason + ")."));
}

/// A list of NAME=VALUE, as GDAL takes options.
class OptionList
{
public:
  OptionList() = default;
  ~OptionList() { gdal().CSLDestroy(this->List); }
  OptionList(const OptionList&) = delete;
  OptionList& operator=(const OptionList&) = delete;

  void set(const char* name, const std::string& value)
  {
    this->List = gdal().CSLSetNameValue(this->List, name, value.c_str());
  }
  char** list() const { return this->List; }

private:
  char** List = nullptr;
};

class SpatialReference
{
public:
  explicit SpatialReference(const std::string& text)
    : Reference(gdal().OSRNewSpatialReference(nullptr))
  {
    gdal().CPLErrorReset();
    if (gdal().OSRSetFromUserInput(this->Reference, text.c_str()) != OGRERR_NONE)
    {
      gdal().OSRDestroySpatialReference(this->Reference);
      const std::string start = text.substr(0, 60);
      throw IOError("'" + start +
        "' is no coordinate reference system that GDAL knows; give --crs "
        "EPSG:CODE.");
    }
  }
  ~SpatialReference() { gdal().OSRDestroySpatialReference(this->Reference); }
  SpatialReference(const SpatialReference&) = delete;
  SpatialReference& operator=(const SpatialReference&) = delete;

  OGRSpatialReferenceH handle() const { return this->Reference; }

private:
  OGRSpatialReferenceH Reference;
};

/// Of the values of a band.
struct BandSums
{
  double Least = std::numeric_limits<double>::infinity();
  double Most = -std::numeric_limits<double>::infinity();
  double Sum = 0;
  double Squares = 0; ///< of differences from the first value
  double First = 0;
  std::int64_t Count = 0;

  void add(double value)
  {
    this->First = this->Count == 0 ? value : this->First;
    const double difference = value - this->First;
    this->Least = std::min(this->Least, value);
    this->Most = std::max(this->Most, value);
    this->Sum += difference;
    this->Squares += difference * difference;
    ++this->Count;
  }
  double mean() const { return this->First + this->Sum / double(this->Count); }
  double deviation() const
  {
    const double mean = this->Sum / double(this->Count);
    return std::sqrt(std::max(0.0, this->Squares / double(this->Count) - mean * mean));
  }
};

struct CloseDataSet
{
  void operator()(void* data) const { gdal().GDALClose(data); }
};
using DataSet = std::unique_ptr<void, CloseDataSet>;

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
    const RasterGrid& grid = description.Grid;
    if (description.CloudOptimized)
    {
      this->Plain = std::make_unique<PendingFile>(path + ".plain");
    }
    // Most memory goes to rows here; GDAL's own cache would take a part of the machine's.
    const std::int64_t megabytes = description.CloudOptimized ? 16 : 4;
    gdal().GDALSetCacheMax64(megabytes << 20);
    gdal().CPLErrorReset();
    OptionList options;
    this->setLayout(options);
    this->Data.reset(gdal().GDALCreate(gdal().GDALGetDriverByName("GTiff"),
      (this->Plain ? *this->Plain : this->Pending).temporaryPath().c_str(), int(grid.Columns),
      int(grid.Rows), int(description.Bands.size()), description.Double ? GDT_Float64 : GDT_Float32,
      options.list()));
    if (!this->Data)
    {
      fail(path, "cannot be written as a GeoTIFF");
    }
    this->describe();
  }

  void write(const RasterWindow& window, const std::vector<const double*>& bands) override
  {
    const auto width = std::size_t(window.Columns);
    const auto count = std::size_t(window.Rows);
    this->Pixels.resize(width * count);
    for (std::size_t band = 0; band < bands.size(); ++band)
    {
      for (std::size_t row = 0; row < count; ++row)
      {
        this->encode(bands[band] + row * width, width,
          this->Pixels.data() + (count - 1 - row) * width, this->Sums[band]);
      }
      const CPLErr error =
        gdal().GDALRasterIO(gdal().GDALGetRasterBand(this->Data.get(), int(band) + 1), GF_Write,
          int(window.Column), int(this->Description.Grid.Rows - window.Row - window.Rows),
          int(width), int(count), this->Pixels.data(), int(width), int(count), GDT_Float64, 0, 0);
      if (error != CE_None)
      {
        fail(this->Path, "cannot be written");
      }
    }
  }

  void close() override
  {
    for (std::size_t band = 0; band < this->Sums.size(); ++band)
    {
      const BandSums& sums = this->Sums[band];
      if (sums.Count > 0)
      {
        gdal().GDALSetRasterStatistics(gdal().GDALGetRasterBand(this->Data.get(), int(band) + 1),
          sums.Least, sums.Most, sums.mean(), sums.deviation());
      }
    }
    gdal().CPLErrorReset();
    this->Plain ? this->makeCloudOptimized() : void();
    this->Data.reset();
    if (gdal().CPLGetLastErrorType() == CE_Failure || gdal().CPLGetLastErrorType() == CE_Fatal)
    {
      fail(this->Path, "cannot be written");
    }
    this->Pending.commit();
  }

private:
  void setCompression(OptionList& options) const
  {
    const std::string& compression = this->Description.Compression;
    std::string name = compression;
    std::transform(name.begin(), name.end(), name.begin(),
      [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    options.set("COMPRESS", name);
    options.set("NUM_THREADS", std::to_string(this->Description.Threads));
    options.set("BIGTIFF", "IF_SAFER");
  }

  void setLayout(OptionList& options) const
  {
    options.set("TILED", "YES");
    if (this->Plain)
    {
      options.set("BIGTIFF", "IF_SAFER");
      return;
    }
    this->setCompression(options);
    if (this->Description.Compression != "none")
    {
      options.set("PREDICTOR", "3"); // for floating-point numbers
      options.set("INTERLEAVE", "BAND");
    }
    if (this->Description.Compression == "deflate")
    {
      options.set("ZLEVEL", "1"); // higher ones take twice the time for a few per cent
    }
  }

  void describe() const
  {
    const RasterGrid& grid = this->Description.Grid;
    void* const data = this->Data.get();
    double transform[6] = { grid.West, grid.Pixel[0], 0, grid.north(), 0, -grid.Pixel[1] };
    bool good = gdal().GDALSetGeoTransform(data, transform) == CE_None;
    gdal().GDALSetMetadataItem(data, "AREA_OR_POINT", "Area", nullptr);
    if (!this->Description.Crs.empty())
    {
      const SpatialReference reference(this->Description.Crs);
      good = gdal().GDALSetSpatialRef(data, reference.handle()) == CE_None && good;
    }
    for (std::size_t band = 0; band < this->Description.Bands.size(); ++band)
    {
      const GDALRasterBandH handle = gdal().GDALGetRasterBand(data, int(band) + 1);
      gdal().GDALSetDescription(handle, this->Description.Bands[band].c_str());
      good = gdal().GDALSetRasterNoDataValue(handle, this->Description.NoData) == CE_None && good;
    }
    if (!good)
    {
      fail(this->Path, "cannot be described as a GeoTIFF");
    }
  }

  /// A row as the file has it.
  void encode(const double* from, std::size_t width, double* to, BandSums& sums) const
  {
    for (std::size_t i = 0; i < width; ++i)
    {
      const double value = this->Description.Double ? from[i] : double(float(from[i]));
      if (std::isnan(value))
      {
        to[i] = this->Description.NoData;
        continue;
      }
      to[i] = value;
      sums.add(value);
    }
  }

  void makeCloudOptimized()
  {
    gdal().GDALFlushCache(this->Data.get());
    OptionList options;
    this->setCompression(options);
    options.set("PREDICTOR", this->Description.Compression == "none" ? "NO" : "YES");
    options.set("STATISTICS", "YES");
    const DataSet copy(gdal().GDALCreateCopy(gdal().GDALGetDriverByName("COG"),
      this->Pending.temporaryPath().c_str(), this->Data.get(), 0, options.list(), nullptr,
      nullptr));
    if (!copy)
    {
      fail(this->Path, "cannot be written as a cloud optimized GeoTIFF");
    }
  }

  const std::string Path;
  const RasterDescription Description;
  PendingFile Pending;
  std::unique_ptr<PendingFile> Plain; ///< what a cloud optimized one is copied from
  std::vector<BandSums> Sums;
  DataSet Data;               ///< closed before the files go away
  std::vector<double> Pixels; ///< of a window
};

} // namespace

std::unique_ptr<RasterWriter> createGeoTiff(
  const std::string& path, const RasterDescription& description, const PathState& before)
{
  return std::make_unique<GeoTiffWriter>(path, description, before);
}

RasterInfo readRasterInfo(const std::string& path)
{
  gdal().CPLErrorReset();
  const DataSet data(gdal().GDALOpen(path.c_str(), GA_ReadOnly));
  if (!data)
  {
    fail(path, "cannot be read as a raster");
  }
  double transform[6];
  if (gdal().GDALGetGeoTransform(data.get(), transform) != CE_None || transform[2] != 0 ||
    transform[4] != 0 || !(transform[1] > 0) || !(transform[5] < 0))
  {
    throw IOError(path, "is no raster whose rows run from west to east and from north to south.");
  }
  RasterInfo info;
  RasterGrid& grid = info.Grid;
  grid.Columns = gdal().GDALGetRasterXSize(data.get());
  grid.Rows = gdal().GDALGetRasterYSize(data.get());
  grid.Pixel = { transform[1], -transform[5] };
  grid.West = transform[0];
  grid.South = transform[3] + double(grid.Rows) * transform[5];
  const char* const crs = gdal().GDALGetProjectionRef(data.get());
  info.Crs = crs ? crs : "";
  return info;
}

void requireCrs(const std::string& text)
{
  const SpatialReference reference(text);
}

} // namespace tipp
