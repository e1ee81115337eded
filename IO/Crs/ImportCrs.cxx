// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/ImportCrs.h"

#include "Crs/GeoKeys.h"
#include "Files/TextFile.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace tipp
{
namespace
{

GdalReference newReference()
{
  return GdalReference(gdal().OSRNewSpatialReference(nullptr));
}

GdalReference importEpsg(int code)
{
  GdalReference system = newReference();
  return gdal().OSRImportFromEPSG(system.get(), code) == OGRERR_NONE ? std::move(system) : nullptr;
}

/// Imports "EPSG:code" or "EPSG:code+code"; null for any other text.
GdalReference importCodes(const std::string& text)
{
  constexpr std::size_t prefix = 5;
  const std::size_t plus = text.find('+');
  const auto horizontal = wholeNumber<int>(text.substr(prefix, plus - prefix));
  GdalReference system = horizontal ? importEpsg(*horizontal) : nullptr;
  if (!system || plus == std::string::npos)
  {
    return system;
  }
  const auto code = wholeNumber<int>(text.substr(plus + 1));
  const GdalReference heights = code ? importEpsg(*code) : nullptr;
  if (!heights || gdal().OSRIsVertical(heights.get()) == 0)
  {
    return nullptr;
  }
  GdalReference both = newReference();
  const std::string name =
    std::string(gdal().OSRGetName(system.get())) + " + " + gdal().OSRGetName(heights.get());
  return gdal().OSRSetCompoundCS(both.get(), name.c_str(), system.get(), heights.get()) ==
      OGRERR_NONE
    ? std::move(both)
    : nullptr;
}

/// Imports PROJJSON. GDAL tries the text as other things, too, the name of a file among them; a
/// JSON text without slashes cannot lead out of the current folder, and names no address.
GdalReference importProjJson(const std::string& text)
{
  const nlohmann::json parsed = nlohmann::json::parse(text, nullptr, false);
  if (!parsed.is_object())
  {
    return nullptr;
  }
  std::string plain;
  for (const char c : parsed.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace))
  {
    plain += c == '/' ? std::string("\\u002f") : std::string(1, c);
  }
  GdalReference system = newReference();
  return gdal().OSRSetFromUserInput(system.get(), plain.c_str()) == OGRERR_NONE ? std::move(system)
                                                                                : nullptr;
}

GdalReference importWkt(std::string text)
{
  GdalReference system = newReference();
  char* begin = text.data();
  return gdal().OSRImportFromWkt(system.get(), &begin) == OGRERR_NONE ? std::move(system) : nullptr;
}

/// A classic, little-endian TIFF of one pixel.
class SmallTiff
{
public:
  SmallTiff()
  {
    constexpr int width = 256;
    constexpr int height = 257;
    constexpr int bitsPerSample = 258;
    constexpr int stripOffset = 273;
    constexpr int stripBytes = 279;
    constexpr int scale = 33550;
    constexpr int tiepoint = 33922;
    for (const int tag : { width, height, stripBytes })
    {
      this->addNumbers<std::uint16_t>(tag, TiffField::Type::Short, { 1 });
    }
    this->addNumbers<std::uint16_t>(bitsPerSample, TiffField::Type::Short, { 8 });
    this->addNumbers<std::uint16_t>(stripOffset, TiffField::Type::Short, { pixelAt });
    this->addNumbers<double>(scale, TiffField::Type::Double, { 1, 1, 0 });
    this->addNumbers<double>(tiepoint, TiffField::Type::Double, { 0, 0, 0, 0, 0, 0 });
  }

  /// Adds a field; its bytes are whole values.
  void add(int tag, TiffField::Type type, std::string bytes)
  {
    this->Fields.push_back({ std::uint16_t(tag), type, std::move(bytes) });
  }

  std::string bytes() const
  {
    std::vector<TiffField> sorted = this->Fields;
    std::sort(sorted.begin(), sorted.end(),
      [](const TiffField& a, const TiffField& b) { return a.Tag < b.Tag; });
    std::string directory = bytesOf(std::uint16_t(sorted.size()));
    std::string values;
    const std::size_t valuesAt = pixelAt + 2 + 2 + 12 * sorted.size() + 4;
    for (const TiffField& field : sorted)
    {
      const std::uint32_t size = sizeOf(field.Is);
      directory +=
        bytesOf(field.Tag) + bytesOf(field.Is) + bytesOf(std::uint32_t(field.Bytes.size() / size));
      std::string here = field.Bytes;
      if (here.size() > 4)
      {
        here = bytesOf(std::uint32_t(valuesAt + values.size()));
        values += field.Bytes + std::string(field.Bytes.size() % 2, '\0');
      }
      directory += here + std::string(4 - here.size(), '\0');
    }
    return std::string("II*\0", 4) + bytesOf(std::uint32_t(pixelAt + 2)) + std::string(2, '\0') +
      directory + std::string(4, '\0') + values;
  }

private:
  static constexpr std::uint16_t pixelAt = 8; ///< behind the header

  template <typename T>
  static std::string bytesOf(T value)
  {
    return { reinterpret_cast<const char*>(&value), sizeof(T) };
  }
  static std::uint32_t sizeOf(TiffField::Type type)
  {
    return type == TiffField::Type::Double ? sizeof(double)
      : type == TiffField::Type::Short     ? 2
                                           : 1;
  }
  template <typename T>
  void addNumbers(int tag, TiffField::Type type, std::initializer_list<T> values)
  {
    this->add(
      tag, type, { reinterpret_cast<const char*>(values.begin()), sizeof(T) * values.size() });
  }

  std::vector<TiffField> Fields;
};

} // namespace

std::string wktOf(OGRSpatialReferenceH system, const char* format)
{
  const std::string option = std::string("FORMAT=") + format;
  const std::array<const char*, 2> options = { option.c_str(), nullptr };
  char* text = nullptr;
  const bool isGood = gdal().OSRExportToWktEx(system, &text, options.data()) == OGRERR_NONE;
  std::string result = isGood && text ? text : "";
  gdal().VSIFree(text);
  return result;
}

GdalReference importCrs(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos)
  {
    return nullptr;
  }
  return text.compare(first, 5, "EPSG:") == 0 ? importCodes(text.substr(first))
    : text[first] == '{'                      ? importProjJson(text)
                                              : importWkt(text.substr(first));
}

GdalReference importUserCrs(const std::string& text)
{
  GdalReference system = importCrs(text);
  const bool isOfGdal = text.compare(0, 4, "/vsi") == 0; // its file systems, the network among them
  if (!system && !isOfGdal)
  {
    system = newReference();
    if (gdal().OSRSetFromUserInput(system.get(), text.c_str()) != OGRERR_NONE)
    {
      return nullptr;
    }
  }
  return system;
}

GdalReference importGeoKeys(const CrsRecords& records)
{
  constexpr int directory = 34735;
  constexpr int doubles = 34736;
  constexpr int ascii = 34737;
  SmallTiff tiff;
  const auto add = [&tiff](
                     int tag, TiffField::Type type, std::size_t size, const std::string& bytes)
  {
    const std::string whole = bytes.substr(0, bytes.size() - bytes.size() % size);
    if (!whole.empty())
    {
      tiff.add(tag, type, whole);
    }
  };
  add(directory, TiffField::Type::Short, sizeof(std::uint16_t), records.Keys);
  add(doubles, TiffField::Type::Double, sizeof(double), records.Doubles);
  add(ascii, TiffField::Type::Text, 1, records.Ascii);
  std::string bytes = tiff.bytes();
  const char* const path = "/vsimem/tipp-keys.tif";
  VSILFILE* const file =
    gdal().VSIFileFromMemBuffer(path, reinterpret_cast<GByte*>(bytes.data()), bytes.size(), FALSE);
  if (file)
  {
    static_cast<void>(gdal().VSIFCloseL(file));
  }
  const std::array<const char*, 2> drivers = { "GTiff", nullptr };
  GdalReference system;
  {
    const GdalDataSet data(
      gdal().GDALOpenEx(path, GDAL_OF_RASTER, drivers.data(), nullptr, nullptr));
    const OGRSpatialReferenceH found = data ? gdal().GDALGetSpatialRef(data.get()) : nullptr;
    system.reset(found && gdal().OSRIsLocal(found) == 0 ? gdal().OSRClone(found) : nullptr);
  }
  gdal().VSIUnlink(path);
  if (system)
  {
    gdal().OSRStripVertical(system.get());
  }
  return system;
}

} // namespace tipp
