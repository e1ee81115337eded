// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/GdalRaster.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Raster/GdalLibrary.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tipp
{
std::string runInChild(const std::function<std::string()>& work)
{
  constexpr char success = '+';
  constexpr char failure = '-';
  const int memory = memfd_create("tipp-result", MFD_CLOEXEC);
  if (memory < 0)
  {
    return work();
  }
  const OutputFile output(memory, "The result of a child process");
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0)
  {
    // This process' signal handlers wake a thread that the child does not have.
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
    {
      _exit(1);
    }
    try
    {
      char kind = success;
      std::string text;
      try
      {
        text = work();
      }
      catch (const std::exception& error)
      {
        kind = failure;
        text = error.what();
      }
      output.write(1, text.data(), text.size());
      output.write(0, &kind, 1); // last, because it shows that the result is complete
      _exit(0);                  // skips this process' own clean-up
    }
    catch (...)
    {
      _exit(1);
    }
  }
  if (child < 0)
  {
    return work(); // fork() failed: run in this process
  }
  int status = 0; // stays 0 if SIGCHLD is ignored
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  const InputFile input("/proc/self/fd/" + std::to_string(memory));
  std::string result(std::size_t(input.size()), '\0');
  input.read(0, result.data(), result.size());
  const char kind = result.empty() ? '\0' : result.front();
  if (status != 0 || (kind != success && kind != failure))
  {
    throw IOError("A process that was to do a part of the work has ended early; try again.");
  }
  result.erase(0, 1);
  return kind == success ? result : throw IOError(result);
}

namespace
{

/// Throws IOError with GDAL's last error message.
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

/// A list of GDAL options, NAME=VALUE each.
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

template <typename T>
T valueAt(const std::string& bytes, std::size_t offset)
{
  T value;
  if (offset + sizeof value > bytes.size())
  {
    throw IOError("GDAL has made a GeoTIFF that ends too early.");
  }
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// The bytes of a GeoTIFF of one pixel that GDAL writes with this reference system.
std::string smallGeoTiff(const std::string& crs)
{
  const GdalOwner<OGRSpatialReferenceH, &GdalLibrary::OSRDestroySpatialReference> reference(
    gdal().OSRNewSpatialReference(nullptr));
  gdal().CPLErrorReset();
  if (gdal().OSRSetFromUserInput(reference.get(), crs.c_str()) != OGRERR_NONE)
  {
    throw IOError("'" + crs.substr(0, 60) +
      "' is no coordinate reference system that GDAL knows; give --crs EPSG:CODE.");
  }
  const char* const path = "/vsimem/tipp-geokeys.tif";
  GdalDataSet data(
    gdal().GDALCreate(gdal().GDALGetDriverByName("GTiff"), path, 1, 1, 1, GDT_Byte, nullptr));
  double transform[6] = { 0, 1, 0, 0, 0, -1 };
  if (!data || gdal().GDALSetGeoTransform(data.get(), transform) != CE_None ||
    gdal().GDALSetSpatialRef(data.get(), reference.get()) != CE_None)
  {
    fail(crs.substr(0, 60), "cannot be described as a GeoTIFF");
  }
  gdal().GDALSetMetadataItem(data.get(), "AREA_OR_POINT", "Area", nullptr);
  data.reset();
  vsi_l_offset size = 0;
  const GByte* const bytes = gdal().VSIGetMemFileBuffer(path, &size, FALSE);
  std::string content(reinterpret_cast<const char*>(bytes), bytes ? std::size_t(size) : 0);
  gdal().VSIUnlink(path);
  return content;
}

/// Extracts the GeoTIFF fields of a little-endian TIFF.
std::vector<TiffField> readGeoKeys(const std::string& tiff)
{
  const std::map<std::uint16_t, std::size_t> tags = { { 34735, sizeof(std::uint16_t) },
    { 34736, sizeof(double) }, { 34737, 1 } };
  if (tiff.compare(0, 4, std::string("II*\0", 4)) != 0)
  {
    throw IOError("GDAL has made a GeoTIFF of another kind than asked for.");
  }
  std::vector<TiffField> fields;
  const std::size_t directory = valueAt<std::uint32_t>(tiff, 4);
  for (std::size_t i = 0; i < valueAt<std::uint16_t>(tiff, directory); ++i)
  {
    const std::size_t at = directory + 2 + 12 * i;
    const auto tag = tags.find(valueAt<std::uint16_t>(tiff, at));
    if (tag == tags.end())
    {
      continue;
    }
    const std::size_t size = tag->second * valueAt<std::uint32_t>(tiff, at + 4);
    const std::size_t begin = size <= 4 ? at + 8 : valueAt<std::uint32_t>(tiff, at + 8);
    fields.push_back(
      { tag->first, static_cast<TiffField::Type>(valueAt<std::uint16_t>(tiff, at + 2)),
        tiff.substr(std::min(begin, tiff.size()), size) });
  }
  return fields;
}

std::string upperCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

} // namespace

const std::vector<TiffField>& geoKeysOf(const std::string& crs)
{
  static std::mutex mutex;
  static std::map<std::string, std::vector<TiffField>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = known.find(crs);
  return found != known.end()
    ? found->second
    : known.emplace(crs, readGeoKeys(runInChild([&crs] { return smallGeoTiff(crs); })))
        .first->second;
}

void requireConversion(const RasterDescription& description, const std::string& path)
{
  runInChild(
    [&]
    {
      OptionList options;
      options.set("COMPRESS", upperCase(description.Compression));
      const GdalDataSet data(gdal().GDALCreate(gdal().GDALGetDriverByName("GTiff"),
        "/vsimem/tipp-conversion.tif", 1, 1, 1, GDT_Float32, options.list()));
      if (!data || (description.CloudOptimized && !gdal().GDALGetDriverByName("COG")))
      {
        fail(path, "cannot be written as a GeoTIFF of this kind");
      }
      return std::string();
    });
}

void convertGeoTiff(const std::string& from, const std::string& to,
  const RasterDescription& description, const std::string& path)
{
  constexpr std::int64_t cacheBytes = 16 << 20; // GDAL's default depends on the machine's memory
  gdal().GDALSetCacheMax64(cacheBytes);
  gdal().CPLErrorReset();
  OptionList options;
  options.set("COMPRESS", upperCase(description.Compression));
  options.set(
    "NUM_THREADS", description.Threads > 0 ? std::to_string(description.Threads) : "ALL_CPUS");
  options.set("BIGTIFF", "IF_SAFER");
  const bool isCompressed = description.Compression != "none";
  if (description.CloudOptimized)
  {
    options.set("PREDICTOR", isCompressed ? "YES" : "NO");
    options.set("STATISTICS", "YES");
  }
  else
  {
    options.set("TILED", "YES");
    options.set("PREDICTOR", "3"); // for floating-point numbers
    options.set("INTERLEAVE", "BAND");
    if (description.Compression == "deflate")
    {
      options.set("ZLEVEL", "1"); // higher levels take twice the time and gain a few per cent
    }
  }
  const GdalDataSet plain(gdal().GDALOpen(from.c_str(), GA_ReadOnly));
  GdalDataSet copy(plain ? gdal().GDALCreateCopy(gdal().GDALGetDriverByName(
                                                   description.CloudOptimized ? "COG" : "GTiff"),
                             to.c_str(), plain.get(), 0, options.list(), nullptr, nullptr)
                         : nullptr);
  if (!copy)
  {
    fail(path, "cannot be written as a GeoTIFF of this kind");
  }
  copy.reset();
  if (gdal().CPLGetLastErrorType() == CE_Failure || gdal().CPLGetLastErrorType() == CE_Fatal)
  {
    fail(path, "cannot be written");
  }
}

RasterInfo readRasterInfo(const std::string& path)
{
  gdal().CPLErrorReset();
  const GdalDataSet data(gdal().GDALOpen(path.c_str(), GA_ReadOnly));
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
  grid.North = transform[3];
  const char* const crs = gdal().GDALGetProjectionRef(data.get());
  info.Crs = crs ? crs : "";
  return info;
}

void requireCrs(const std::string& text)
{
  geoKeysOf(text);
}

} // namespace tipp
