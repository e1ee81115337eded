// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/GeoKeys.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace tipp
{
namespace
{

constexpr int metre = 9001;
constexpr int foot = 9002;
constexpr int surveyFoot = 9003;

/// A system of heights: its code in GeoTIFF 1.0 (section 6.3.4.1; 0: none), its EPSG code, and its
/// unit.
struct KnownHeights
{
  int GeoTiff;
  int Epsg;
  int Unit;
};

/// The systems with a code of GeoTIFF 1.0, and those whose unit is not the metre. Of several with
/// one code of GeoTIFF, the first has the unit that holds if the file states none.
constexpr std::array<KnownHeights, 15> knownHeights = { { { 5101, 5701, metre },
  { 5102, 5702, surveyFoot }, { 5102, 7968, metre }, { 5103, 5703, metre },
  { 5103, 6360, surveyFoot }, { 5103, 8228, foot }, { 5104, 5736, metre }, { 5105, 5705, metre },
  { 5106, 5611, metre }, { 0, 8050, foot }, { 0, 8052, surveyFoot }, { 0, 6130, foot },
  { 0, 6131, foot }, { 0, 6132, foot }, { 0, 5754, 9095 } } };

/// Returns the unit of a system of heights; that of nearly all is the metre.
int unitOf(int epsg)
{
  const auto known = std::find_if(knownHeights.begin(), knownHeights.end(),
    [epsg](const KnownHeights& heights) { return heights.Epsg == epsg; });
  return known == knownHeights.end() ? metre : known->Unit;
}

std::string nameOfUnit(int unit)
{
  return unit == metre   ? "metres"
    : unit == foot       ? "feet"
    : unit == surveyFoot ? "US survey feet"
                         : "the unit with the code " + std::to_string(unit);
}

} // namespace

GeoKeys::GeoKeys(const CrsRecords& records)
{
  // Four 16-bit numbers per key: its id, the tag that has its value (0: this one), the count, and
  // the value. The first four are a header.
  const std::size_t entries = records.Keys.size() / 8;
  for (std::size_t i = 1; i < entries; ++i)
  {
    std::array<std::uint16_t, 4> entry{};
    std::memcpy(entry.data(), records.Keys.data() + 8 * i, sizeof entry);
    if (entry[1] != 0)
    {
      continue;
    }
    int* const slot = entry[0] == 2048 ? &this->Geographic
      : entry[0] == 3072               ? &this->Projected
      : entry[0] == 4096               ? &this->Heights
      : entry[0] == 4099               ? &this->UnitOfHeights
                                       : nullptr;
    if (slot)
    {
      *slot = entry[3];
    }
  }
}

int GeoKeys::horizontal() const
{
  // With a user-defined projection, the geographic system is not that of the points.
  const int code = this->Projected > 0 ? this->Projected : this->Geographic;
  return code == UserDefined ? -1 : code;
}

HeightCode GeoKeys::height() const
{
  const int code = this->Heights;
  if (code == 0 || code == UserDefined)
  {
    return { 0,
      code == 0 ? "" : "describes its heights by a system of its own, which is not understood" };
  }
  if (code >= 5001 && code <= 5033) // GeoTIFF 1.0: heights above one of its ellipsoids
  {
    return { 0,
      "gives heights above an ellipsoid (GeoTIFF's code " + std::to_string(code) +
        "), for which EPSG has no code of its own" };
  }
  const auto known = std::find_if(knownHeights.begin(), knownHeights.end(),
    [code](const KnownHeights& heights)
    { return heights.GeoTiff == code || heights.Epsg == code; });
  const int family = known == knownHeights.end() ? 0 : known->GeoTiff;
  const int unit = this->UnitOfHeights;
  if (unit == 0 || (family != code && unit == unitOf(code)))
  {
    return { family == code ? known->Epsg : code, "" };
  }
  const auto inUnit = std::find_if(knownHeights.begin(), knownHeights.end(),
    [&](const KnownHeights& heights) { return heights.GeoTiff == family && heights.Unit == unit; });
  if (family > 0 && inUnit != knownHeights.end())
  {
    return { inUnit->Epsg, "" };
  }
  return { 0,
    "gives heights in " + nameOfUnit(unit) + " and the code " + std::to_string(code) +
      ", which has no variant in this unit" };
}

} // namespace tipp
