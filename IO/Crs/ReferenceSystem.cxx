// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/ReferenceSystem.h"

#include "Crs/GeoKeys.h"
#include "Crs/StatedCodes.h"
#include "Files/ChildProcess.h"
#include "Files/IOError.h"
#ifdef TIPP_HAVE_GDAL
#include "Crs/ImportCrs.h"
#else
#include "Crs/WriteGeoKeys.h"
#endif

#include <algorithm>
#include <map>
#include <mutex>

namespace tipp
{
namespace
{

/// Returns the system that the codes of keys name, and what they leave open, without GDAL.
ReferenceSystem fromCodes(const GeoKeys& keys)
{
  ReferenceSystem system;
  const int horizontal = keys.horizontal();
  if (horizontal <= 0)
  {
    system.Problem = "gives no EPSG code for its coordinate reference system";
    return system;
  }
  const HeightCode height = keys.height();
  system.Text = "EPSG:" + std::to_string(horizontal) +
    (height.Epsg > 0 ? "+" + std::to_string(height.Epsg) : std::string());
  system.Problem = height.Problem;
  return system;
}

} // namespace

#ifdef TIPP_HAVE_GDAL

namespace
{

/// Returns the EPSG code of a part of a system ("VERT_CS"; null: the whole); 0 if it has none.
int epsgOf(OGRSpatialReferenceH system, const char* part)
{
  const char* const authority = gdal().OSRGetAuthorityName(system, part);
  const char* const code = gdal().OSRGetAuthorityCode(system, part);
  return authority && code && std::string(authority) == "EPSG" ? std::atoi(code) : 0;
}

/// Whether an axis points to the south or the west, as in EPSG:5513. Such systems differ from those
/// with the same parameters and other axes.
bool isReversed(OGRSpatialReferenceH system)
{
  for (int axis = 0; axis < 2; ++axis)
  {
    OGRAxisOrientation orientation = OAO_Other;
    gdal().OSRGetAxis(system, nullptr, axis, &orientation);
    if (orientation == OAO_South || orientation == OAO_West)
    {
      return true;
    }
  }
  return false;
}

bool isSame(OGRSpatialReferenceH a, OGRSpatialReferenceH b)
{
  const std::array<const char*, 3> options = { "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
    "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr };
  return gdal().OSRIsSameEx(a, b, options.data()) != 0;
}

/// Compares horizontal systems. x is the easting in files of points, so the order of the axes does
/// not matter, which ESRI's WKT does not state, either.
bool isSameHorizontal(OGRSpatialReferenceH a, OGRSpatialReferenceH b)
{
  if (isSame(a, b))
  {
    return true;
  }
  const GdalReference plainA = importCrs(wktOf(a, "SFSQL"));
  const GdalReference plainB = importCrs(wktOf(b, "SFSQL"));
  return !isReversed(a) && !isReversed(b) && plainA && plainB && isSame(plainA.get(), plainB.get());
}

GdalReference withoutHeights(OGRSpatialReferenceH system)
{
  GdalReference horizontal(gdal().OSRClone(system));
  gdal().OSRStripVertical(horizontal.get());
  return horizontal;
}

/// Returns the EPSG code whose definition is that of a horizontal system; 0 if there is none.
int matchingEpsg(OGRSpatialReferenceH system)
{
  const int own = epsgOf(system, nullptr);
  if (own > 0)
  {
    const GdalReference named = importCrs("EPSG:" + std::to_string(own));
    return named && isSameHorizontal(named.get(), system) ? own : 0;
  }
  constexpr int certain = 90; // per cent: only the names differ
  int count = 0;
  int* confidence = nullptr;
  OGRSpatialReferenceH* const found = gdal().OSRFindMatches(system, nullptr, &count, &confidence);
  const int code = count > 0 && confidence[0] >= certain ? epsgOf(found[0], nullptr) : 0;
  gdal().OSRFreeSRSArray(found);
  gdal().VSIFree(confidence);
  return code;
}

std::string codeInWords(int epsg)
{
  return epsg > 0 ? " (EPSG:" + std::to_string(epsg) + ")" : std::string();
}

std::string unitOf(OGRSpatialReferenceH system, const char* part)
{
  char* name = nullptr;
  if (!part && gdal().OSRIsGeographic(system) != 0)
  {
    gdal().OSRGetAngularUnits(system, &name);
  }
  else
  {
    gdal().OSRGetTargetLinearUnits(system, part, &name);
  }
  return name ? name : "unknown";
}

/// Describes a system: its Text and Words.
ReferenceSystem describe(OGRSpatialReferenceH system)
{
  const GdalReference horizontal = withoutHeights(system);
  const int code = matchingEpsg(horizontal.get());
  const char* const heights = gdal().OSRGetAttrValue(system, "VERT_CS", 0);
  const int heightCode = heights ? epsgOf(system, "VERT_CS") : 0;
  ReferenceSystem result;
  result.Text = code > 0 && (!heights || heightCode > 0)
    ? "EPSG:" + std::to_string(code) + (heights ? "+" + std::to_string(heightCode) : "")
    : wktOf(system);
  const char* const name = gdal().OSRGetName(horizontal.get());
  result.Words = std::string(name ? name : "unnamed") + codeInWords(code) +
    ", x and y in units of " + unitOf(horizontal.get(), nullptr);
  result.Words += heights ? "; heights: " + std::string(heights) + codeInWords(heightCode) +
      ", in units of " + unitOf(system, "VERT_CS")
                          : "; no system of heights";
  return result;
}

std::string reasonOfGdal()
{
  const std::string reason = shownText(gdal().CPLGetLastErrorMsg());
  return reason.empty() ? "" : " (" + reason + ")";
}

/// Software of ESRI writes its own codes into the 16 bits of a key, which cuts them. Returns a hint
/// at the system that a code may have been.
std::string uncut(int code)
{
  constexpr int cut = 1 << 16;
  const std::string whole = "ESRI:" + std::to_string(code + cut);
  const GdalReference system = importUserCrs(whole);
  const char* const name = system ? gdal().OSRGetName(system.get()) : nullptr;
  return name ? "; perhaps " + whole + " (" + name + ") is meant" : std::string();
}

/// Understands GeoTIFF's keys: GDAL the horizontal part, which may be a projection with parameters,
/// and our table the heights.
ReferenceSystem fromKeys(const CrsRecords& records)
{
  const GeoKeys keys(records);
  const GdalReference horizontal = importGeoKeys(records);
  if (!horizontal)
  {
    ReferenceSystem system;
    const int code = std::max(keys.Projected, keys.Geographic);
    system.Problem = code > 0 && code != GeoKeys::UserDefined
      ? "gives the code " + std::to_string(code) +
        " for its coordinate reference system, which is none of EPSG's" + uncut(code)
      : "describes its coordinate reference system in a way that GDAL does not understand";
    return system;
  }
  const HeightCode height = keys.height();
  if (height.Epsg == 0)
  {
    ReferenceSystem system = describe(horizontal.get());
    system.Problem = height.Problem;
    return system;
  }
  const GdalReference heights = importCrs("EPSG:" + std::to_string(height.Epsg));
  const GdalReference both(gdal().OSRNewSpatialReference(nullptr));
  const std::string name = gdal().OSRGetName(horizontal.get()) + std::string(" + heights");
  const bool isGood = heights && gdal().OSRIsVertical(heights.get()) != 0 &&
    gdal().OSRSetCompoundCS(both.get(), name.c_str(), horizontal.get(), heights.get()) ==
      OGRERR_NONE;
  ReferenceSystem system = describe(isGood ? both.get() : horizontal.get());
  system.Problem = isGood ? ""
                          : "gives the code " + std::to_string(height.Epsg) +
      " for its heights, which is none of EPSG's for heights";
  return system;
}

ReferenceSystem understand(const CrsRecords& records)
{
  ReferenceSystem system;
  if (!records.Text.empty())
  {
    gdal().CPLErrorReset();
    const GdalReference reference = importCrs(records.Text);
    if (reference)
    {
      return describe(reference.get());
    }
    system.Problem = "describes its coordinate reference system by a text that is neither WKT nor "
                     "PROJJSON that GDAL understands" +
      reasonOfGdal();
  }
  return records.Keys.empty() ? system : fromKeys(records);
}

/// A ReferenceSystem as the result of a child process, and back.
std::string packed(const ReferenceSystem& system)
{
  return system.Text + '\0' + system.Words + '\0' + system.Problem;
}

ReferenceSystem unpacked(const std::string& bytes)
{
  const std::size_t first = bytes.find('\0');
  const std::size_t second = bytes.find('\0', first + 1);
  return { bytes.substr(0, first), bytes.substr(first + 1, second - first - 1),
    bytes.substr(second + 1) };
}

/// Returns known[key], which compute() makes if it is not there.
template <typename Key, typename Value, typename Compute>
const Value& remembered(std::map<Key, Value>& known, const Key& key, const Compute& compute)
{
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = known.find(key);
  return found != known.end() ? found->second : known.emplace(key, compute()).first->second;
}

} // namespace

ReferenceSystem understandCrs(const CrsRecords& records)
{
  static std::map<CrsRecords, ReferenceSystem> known;
  if (records.isEmpty())
  {
    return {};
  }
  return remembered(known, records,
    [&records]
    {
      try
      {
        return unpacked(runInChild([&records] { return packed(understand(records)); }));
      }
      catch (const IOError& error) // GDAL is not installed, or has crashed
      {
        ReferenceSystem system =
          records.Text.empty() ? fromCodes(GeoKeys(records)) : ReferenceSystem();
        system.Problem =
          std::string("has a coordinate reference system that is not understood: ") + error.what();
        return system;
      }
    });
}

ReferenceSystem describeCrs(const std::string& text)
{
  static std::map<std::string, ReferenceSystem> known;
  return remembered(known, text,
    [&text]
    {
      ReferenceSystem result;
      try
      {
        result = unpacked(runInChild(
          [&text]
          {
            const GdalReference system = importUserCrs(text);
            return packed(system ? describe(system.get()) : ReferenceSystem());
          }));
      }
      catch (const IOError&) // no GDAL
      {
      }
      result.Text = text;
      return result;
    });
}

std::string wkt1Of(const std::string& text, bool isOfUser)
{
  try
  {
    return runInChild(
      [&]
      {
        const GdalReference system = isOfUser ? importUserCrs(text) : importCrs(text);
        return system ? wktOf(system.get(), "WKT1_GDAL") : std::string();
      });
  }
  catch (const IOError&) // no GDAL
  {
    return "";
  }
}

bool areSameCrs(const std::string& a, const std::string& b)
{
  static std::map<std::pair<std::string, std::string>, bool> known;
  return a == b ||
    remembered(known, { a, b },
      [&]
      {
        return runInChild(
                 [&]
                 {
                   const GdalReference first = importCrs(a);
                   const GdalReference second = importCrs(b);
                   const bool isEqual = first && second &&
                     isSameHorizontal(
                       withoutHeights(first.get()).get(), withoutHeights(second.get()).get()) &&
                     (!hasHeightSystem(a) || !hasHeightSystem(b) ||
                       gdal().OSRIsSameVertCS(first.get(), second.get()) != 0);
                   return std::string(isEqual ? "same" : "");
                 }) == "same";
      });
}

#else

ReferenceSystem understandCrs(const CrsRecords& records)
{
  if (records.isEmpty() || records.Text.empty())
  {
    return records.isEmpty() ? ReferenceSystem() : fromCodes(GeoKeys(records));
  }
  const std::size_t name =
    records.Text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789 \n\r\t");
  ReferenceSystem system;
  const bool isWkt = name != std::string::npos && name > 0 && records.Text[name] == '[';
  (isWkt ? system.Text : system.Problem) =
    isWkt ? records.Text : "describes its coordinate reference system by a text that is not WKT";
  return system;
}

ReferenceSystem describeCrs(const std::string& text)
{
  return { text, "", "" };
}

std::string wkt1Of(const std::string& text, bool isOfUser)
{
  const auto& toWkt1 = crsTranslator().ToWkt1;
  try
  {
    return toWkt1 ? toWkt1(text) : std::string();
  }
  catch (const IOError&) // nothing that translates is installed
  {
    return isOfUser ? throw : std::string();
  }
}

bool areSameCrs(const std::string& a, const std::string& b)
{
  const StatedCodes first = codesOf(a);
  const StatedCodes second = codesOf(b);
  const bool isSameCode = first.Horizontal > 0 && first.Horizontal == second.Horizontal &&
    (first.Heights == 0 || second.Heights == 0 || first.Heights == second.Heights);
  return isSameCode || withoutBlanks(a) == withoutBlanks(b);
}

#endif

} // namespace tipp
