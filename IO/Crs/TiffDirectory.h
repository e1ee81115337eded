// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTiffDirectory_h
#define tippTiffDirectory_h

#include "Crs/GeoKeys.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tipp
{

/// The first directory of a TIFF or BigTIFF of either byte order. Each count and offset is checked
/// against the file's size.
class VTKTIPPIO_EXPORT TiffDirectory
{
public:
  /// Opens a file. Throws IOError if it is no TIFF, or is damaged.
  static TiffDirectory ofFile(const std::string& path);
  /// Reads a file in memory.
  explicit TiffDirectory(const std::string& bytes);

  bool has(std::uint16_t tag) const { return this->Entries.count(tag) > 0; }
  /// Returns the values of a field of whole numbers or of doubles; none if there is no such field.
  /// Throws IOError if the field has another type, more values than a directory needs, or values
  /// outside of the file.
  std::vector<double> numbers(std::uint16_t tag) const;
  /// Returns the field with its values in little-endian order; of type Text with no bytes if there
  /// is none. Throws as numbers().
  TiffField field(std::uint16_t tag) const;

private:
  using Read = std::function<void(std::uint64_t offset, void* to, std::size_t bytes)>;

  /// What the directory says about a field.
  struct Entry
  {
    std::uint16_t Type;
    std::uint64_t Count;
    std::uint64_t At; ///< offset in the file of the value, or of the offset of the values
  };

  TiffDirectory(const std::string& name, std::uint64_t size, Read read);
  [[noreturn]] void fail(const std::string& problem) const;
  std::string bytesAt(std::uint64_t offset, std::uint64_t size) const;
  /// A whole number of the file.
  std::uint64_t numberAt(std::uint64_t offset, std::size_t size) const;
  std::uint64_t wordAt(std::uint64_t offset) const;

  std::string Name;
  std::uint64_t Size;
  Read ReadBytes;
  bool IsBigEndian = false;
  std::size_t Word = 4; ///< size of offsets and counts, in bytes
  std::map<std::uint16_t, Entry> Entries;
};

/// Returns the fields that describe the reference system of a GeoTIFF: its keys, and the numbers
/// and texts that these refer to. Throws IOError if one is damaged.
VTKTIPPIO_EXPORT std::vector<TiffField> geoFieldsOf(const TiffDirectory& directory);

} // namespace tipp

#endif
