// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasHeader_h
#define tippLasHeader_h

#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace tipp
{

/// What the header of a LAS file, version 1.0 to 1.4, says of its points.
struct LasHeader
{
  int Minor = 0;           ///< of the version, 1.Minor
  int Format = 0;          ///< of the points: 0 to 10
  bool Compressed = false; ///< LAZ
  std::size_t RecordLength = 0;
  std::uint64_t PointOffset = 0; ///< of the first record in the file
  std::int64_t Points = 0;
  std::array<double, 3> Scale{};
  std::array<double, 3> Offset{};
  std::array<double, 6> Bounds{}; ///< as the header has them: xmin, xmax, ymin and so on
  /// WKT or "EPSG:code" or "EPSG:code+code"; empty if there is none that is understood.
  std::string Crs;
  bool HasUnknownCrs = false; ///< there are records of a CRS, but not of a usable kind

  bool hasTime() const { return this->Format == 1 || (this->Format >= 3); }
  bool hasColour() const
  {
    return this->Format == 2 || this->Format == 3 || this->Format == 5 || this->Format == 7 ||
      this->Format == 8 || this->Format == 10;
  }
  bool hasInfrared() const { return this->Format == 8 || this->Format == 10; }
  bool isExtended() const { return this->Format >= 6; } ///< 256 classes, 15 returns
};

/// Throws IOError for a file that is not of the format or announces more than it holds.
VTKTIPPIO_EXPORT LasHeader readLasHeader(const std::string& path);

/// .las and .laz.
bool isLasExtension(const std::string& extension);

} // namespace tipp

#endif
