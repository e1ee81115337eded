// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasHeader_h
#define tippLasHeader_h

#include "Crs/ReferenceSystem.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

struct LasSelection;

/// Some bytes of each record besides those of its format: the values of one name.
struct LasExtra
{
  /// Their description in the file's record 4, LasExtra::DescriptorSize bytes; empty: there is
  /// none.
  std::string Descriptor;
  std::size_t Size = 0;   ///< bytes
  std::size_t Offset = 0; ///< of the first one in the record

  static constexpr std::size_t DescriptorSize = 192;

  /// The description without the least and the greatest value, which are those of one file.
  std::string descriptorWithoutRange() const;
  /// The name in the description, or empty.
  std::string name() const;
  /// A text that is equal if two files' bytes mean the same.
  std::string key() const;
};

/// The header of a LAS file, version 1.0 to 1.5.
struct LasHeader
{
  int Minor = 0;                 ///< minor version: the file's version is 1.Minor
  int Format = 0;                ///< point data record format, 0 to 10
  bool Compressed = false;       ///< LAZ
  std::size_t RecordLength = 0;  ///< bytes per point record
  std::uint64_t PointOffset = 0; ///< offset of the first record, in bytes
  std::int64_t Points = 0;       ///< number of point records to read
  std::array<double, 3> Scale{}; ///< a coordinate is its stored integer * Scale + Offset
  std::array<double, 3> Offset{};
  /// The bounds of the points by the header, grown by the rounding of coordinates; empty if the
  /// header's cannot be right.
  Box2 Bounds = Box2::empty();
  CrsRecords Crs;                ///< the records of the coordinate reference system
  std::string Compression;       ///< the record of the compression, or empty
  std::string Copc;              ///< the record 'info' of a COPC file, or empty
  std::uint64_t IndexOffset = 0; ///< of a LASindex among the records, in bytes
  std::uint64_t IndexBytes = 0;  ///< its length; 0: there is none
  std::uint16_t Encoding = 0;    ///< the bits of the global encoding
  std::string System;            ///< the system identifier
  std::vector<LasExtra> Extras;  ///< all bytes of a record besides those of its format, in order
  int OtherRecords = 0; ///< variable length records besides these and those of COPC and LASindex
  std::string Remark;   ///< how Points differs from what the header or the file says, or empty

  bool hasTime() const { return this->Format == 1 || (this->Format >= 3); }
  bool hasColour() const
  {
    return this->Format == 2 || this->Format == 3 || this->Format == 5 || this->Format == 7 ||
      this->Format == 8 || this->Format == 10;
  }
  bool hasInfrared() const { return this->Format == 8 || this->Format == 10; }
  bool isExtended() const { return this->Format >= 6; } ///< 256 classes, 15 returns
  bool hasWaves() const
  {
    return this->Format == 4 || this->Format == 5 || this->Format == 9 || this->Format == 10;
  }
};

/// The number of bytes of a record of a format, 0 to 10, without extra bytes.
VTKTIPPIO_EXPORT std::size_t lasRecordLength(int format);

/// Reads and checks the header. Throws IOError if the file is not LAS, is of a kind that is not
/// read, or has less data than the header announces (unless `selection` keeps truncated files).
VTKTIPPIO_EXPORT LasHeader readLasHeader(const std::string& path, const LasSelection& selection);
VTKTIPPIO_EXPORT LasHeader readLasHeader(const std::string& path);

} // namespace tipp

#endif
