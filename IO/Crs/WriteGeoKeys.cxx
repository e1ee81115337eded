// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/WriteGeoKeys.h"

#include "Crs/EpsgRanges.h"
#include "Crs/StatedCodes.h"
#include "Crs/TiffDirectory.h"
#include "Files/IOError.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <utility>

namespace tipp
{
namespace
{

template <std::size_t Count>
bool has(const EpsgRange (&ranges)[Count], int code)
{
  const auto* const after = std::upper_bound(std::begin(ranges), std::end(ranges), code,
    [](int value, const EpsgRange& range) { return value < range.First; });
  return after != std::begin(ranges) && code <= std::prev(after)->Last;
}

/// Whether EPSG's table has a horizontal system of this code, and the system of heights, if any.
bool areKnown(const StatedCodes& codes)
{
  return (has(projectedCodes, codes.Horizontal) || has(geographicCodes, codes.Horizontal)) &&
    (codes.Heights == 0 || has(verticalCodes, codes.Heights));
}

bool startsWith(const std::string& text, const std::string& start)
{
  return text.compare(0, start.size(), start) == 0;
}

/// Returns the codes that describe all of the system; none if the text states other codes or none.
StatedCodes completeCodes(const std::string& crs)
{
  const StatedCodes codes = codesOf(crs);
  return hasHeightSystem(crs) && codes.Heights == 0 ? StatedCodes() : codes;
}

std::vector<TiffField> translated(const std::string& crs)
{
  const auto& toGeoKeys = crsTranslator().ToGeoKeys;
  const std::string result = toGeoKeys ? toGeoKeys(crs) : std::string();
  for (const char* const kind : { "projected:", "geographic:" })
  {
    if (startsWith(result, kind))
    {
      const StatedCodes codes = codesIn(result.substr(std::string(kind).size()));
      return { geoKeysOfCodes(*kind == 'p', codes.Horizontal, codes.Heights) };
    }
  }
  return result.empty() ? std::vector<TiffField>() : geoFieldsOf(TiffDirectory(result));
}

} // namespace

TiffField geoKeysOfCodes(bool isProjected, int horizontal, int heights)
{
  const auto pixelIsArea = std::uint16_t(1);
  std::vector<std::array<std::uint16_t, 4>> keys = { { 1, 1, std::uint16_t(heights > 0 ? 1 : 0),
                                                       0 }, // version 1.1, revision
    { 1024, 0, 1, std::uint16_t(isProjected ? 1 : 2) },     // GTModelTypeGeoKey
    { 1025, 0, 1, pixelIsArea },                            // GTRasterTypeGeoKey
    { std::uint16_t(isProjected ? 3072 : 2048), 0, 1, std::uint16_t(horizontal) } };
  if (heights > 0)
  {
    keys.push_back({ 4096, 0, 1, std::uint16_t(heights) }); // VerticalGeoKey
  }
  keys.front()[3] = std::uint16_t(keys.size() - 1);
  return { 34735, TiffField::Type::Short,
    std::string(reinterpret_cast<const char*>(keys.data()), keys.size() * sizeof keys.front()) };
}

std::vector<TiffField> geoKeysWithoutGdal(const std::string& crs)
{
  const StatedCodes codes = completeCodes(crs);
  if (areKnown(codes))
  {
    return { geoKeysOfCodes(
      has(projectedCodes, codes.Horizontal), codes.Horizontal, codes.Heights) };
  }
  std::vector<TiffField> fields = translated(crs);
  if (fields.empty())
  {
    const std::string problem = codes.Horizontal > 0
      ? std::string("' is no projected or geographic system of EPSG's data set ") + epsgVersion
      : std::string("' states no EPSG code");
    throw IOError("The coordinate reference system '" + shownText(crs) + problem +
      ", and this tipp was built without GDAL; give --crs EPSG:CODE, or install what translates "
      "it: 'pip install pyproj rasterio'.");
  }
  return fields;
}

CrsTranslator& crsTranslator()
{
  static CrsTranslator translator;
  return translator;
}

} // namespace tipp
