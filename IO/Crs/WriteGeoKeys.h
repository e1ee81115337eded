// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteGeoKeys_h
#define tippWriteGeoKeys_h

#include "Crs/GeoKeys.h"
#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Returns GeoTIFF's key directory for a system of EPSG by its codes alone (OGC 19-008r4, 7.5): the
/// kind of model, and the codes. `heights`: the code of the system of heights; 0: none.
VTKTIPPIO_EXPORT TiffField geoKeysOfCodes(bool isProjected, int horizontal, int heights);

/// Returns the TIFF fields that describe a reference system, without GDAL: by EPSG codes that the
/// text states ("EPSG:code", "EPSG:code+code" or WKT), else by crsTranslator(). Throws IOError
/// with one sentence if neither describes it.
VTKTIPPIO_EXPORT std::vector<TiffField> geoKeysWithoutGdal(const std::string& crs);

/// Translates the text of a reference system in a build without GDAL.
struct CrsTranslator
{
  /// For a text that states no EPSG code known here. Returns "projected:CODE" or "geographic:CODE",
  /// either with "+CODE" for heights; or the bytes of a GeoTIFF with the system; or an empty text
  /// if it cannot translate any. Throws IOError if it does not understand the text.
  std::function<std::string(const std::string& crs)> ToGeoKeys;
  /// As wkt1Of(). Throws IOError with what to install if it can translate none.
  std::function<std::string(const std::string& crs)> ToWkt1;
};

/// The translator of the process; at the start it has no functions. Set them before any other
/// thread uses reference systems.
VTKTIPPIO_EXPORT CrsTranslator& crsTranslator();

} // namespace tipp

#endif
