// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGeoKeys_h
#define tippGeoKeys_h

#include "Crs/CrsRecords.h"

#include <cstdint>
#include <string>

namespace tipp
{

/// A field of a TIFF file's directory.
struct TiffField
{
  enum class Type : std::uint16_t
  {
    Text = 2,
    Short = 3,
    Long = 4,
    Double = 12,
    Long8 = 16
  };
  std::uint16_t Tag = 0; ///< the field's tag number
  Type Is = Type::Short;
  std::string Bytes; ///< the values, little-endian
};

/// The EPSG code of a system of heights.
struct HeightCode
{
  int Epsg = 0;        ///< 0: none
  std::string Problem; ///< what is not understood, as in ReferenceSystem
};

/// The codes in GeoTIFF's key directory. A key that is absent is 0.
struct GeoKeys
{
  static constexpr int UserDefined = 32767;

  int Geographic = 0;    ///< key 2048
  int Projected = 0;     ///< key 3072
  int Heights = 0;       ///< key 4096
  int UnitOfHeights = 0; ///< key 4099

  /// Reads the keys. Ignores what is damaged.
  explicit GeoKeys(const CrsRecords& records);

  /// The EPSG code of the horizontal system, -1 if that is defined by the user, 0 if there is none.
  int horizontal() const;

  /// The EPSG code of the system of heights, with the unit that the file states. The codes of
  /// GeoTIFF 1.0, which many files from 2005 to 2015 have, are translated.
  HeightCode height() const;
};

} // namespace tipp

#endif
