// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasHeader.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Las/LasCrs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace tipp
{
namespace
{

constexpr std::size_t shortHeader = 227; ///< of versions 1.0 to 1.2
constexpr std::size_t longHeader = 375;  ///< of version 1.4

/// The fewest bytes of a record, of each format.
constexpr std::array<std::size_t, 11> recordLengths = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59,
  67 };

/// Fields of a header in memory, all of them little-endian.
class Fields
{
public:
  Fields(const InputFile& file, std::size_t size)
    : Bytes(size)
  {
    file.read(0, this->Bytes.data(), size);
  }

  template <typename T>
  T at(std::size_t offset) const
  {
    T value;
    std::memcpy(&value, this->Bytes.data() + offset, sizeof(T));
    return value;
  }
  const char* data() const { return this->Bytes.data(); }

private:
  std::vector<char> Bytes;
};

void requireGood(bool condition, const std::string& path, const std::string& problem)
{
  if (!condition)
  {
    throw IOError(path, problem + "; copy it again.");
  }
}

void readFormat(const Fields& fields, const std::string& path, LasHeader& header)
{
  const int format = fields.at<std::uint8_t>(104);
  header.Compressed = (format & 0xC0) != 0;
  header.Format = format & 0x3F;
  header.RecordLength = fields.at<std::uint16_t>(105);
  requireGood(std::size_t(header.Format) < recordLengths.size(), path,
    "is a LAS file with points of format " + std::to_string(header.Format) +
      ", and there are 0 to 10");
  const std::size_t least = recordLengths[std::size_t(header.Format)];
  requireGood(header.RecordLength >= least, path,
    "gives " + std::to_string(header.RecordLength) + " bytes for a point of format " +
      std::to_string(header.Format) + ", which has " + std::to_string(least));
}

void readTransform(const Fields& fields, const std::string& path, LasHeader& header)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    header.Scale[axis] = fields.at<double>(131 + 8 * axis);
    header.Offset[axis] = fields.at<double>(155 + 8 * axis);
    requireGood(std::isfinite(header.Scale[axis]) && header.Scale[axis] != 0 &&
        std::isfinite(header.Offset[axis]),
      path, std::string("has no usable scale or offset of ") + "xyz"[axis] + " in its header");
    header.Bounds[2 * axis] = fields.at<double>(187 + 16 * axis);
    header.Bounds[2 * axis + 1] = fields.at<double>(179 + 16 * axis);
  }
}

void readCount(const Fields& fields, const std::string& path, std::uint64_t fileSize,
  std::size_t headerSize, LasHeader& header)
{
  std::uint64_t count = fields.at<std::uint32_t>(107);
  if (header.Minor >= 4)
  {
    count = fields.at<std::uint64_t>(247);
  }
  header.PointOffset = fields.at<std::uint32_t>(96);
  requireGood(header.PointOffset >= headerSize && header.PointOffset <= fileSize, path,
    "has its points at byte " + std::to_string(header.PointOffset) +
      " by its header, where there is no room for them");
  const std::uint64_t room = (fileSize - header.PointOffset) / header.RecordLength;
  requireGood(header.Compressed ? count < (std::uint64_t(1) << 48) : count <= room, path,
    "announces " + std::to_string(count) + " points and has room for " + std::to_string(room));
  header.Points = std::int64_t(count);
}

} // namespace

bool isLasExtension(const std::string& extension)
{
  return extension == ".las" || extension == ".laz";
}

LasHeader readLasHeader(const std::string& path)
{
  const InputFile file(path);
  requireGood(file.size() >= shortHeader, path, "is too short for a LAS file");
  const Fields start(file, shortHeader);
  requireGood(std::memcmp(start.data(), "LASF", 4) == 0, path, "is not a LAS file");
  LasHeader header;
  const int major = start.at<std::uint8_t>(24);
  header.Minor = start.at<std::uint8_t>(25);
  requireGood(major == 1 && header.Minor <= 4, path,
    "is a LAS file of version " + std::to_string(major) + "." + std::to_string(header.Minor) +
      ", and 1.0 to 1.4 can be read");
  const std::size_t size = start.at<std::uint16_t>(94);
  const std::size_t least = header.Minor >= 4 ? longHeader : shortHeader;
  requireGood(size >= least && size <= file.size(), path,
    "has a header of " + std::to_string(size) + " bytes, too few or too many");
  const Fields fields(file, least);
  readFormat(fields, path, header);
  readTransform(fields, path, header);
  readCount(fields, path, file.size(), size, header);
  LasRecordPlaces places;
  places.Begin = size;
  places.End = header.PointOffset;
  places.Count = fields.at<std::uint32_t>(100);
  if (header.Minor >= 4)
  {
    places.ExtendedBegin = fields.at<std::uint64_t>(235);
    places.ExtendedCount = fields.at<std::uint32_t>(243);
  }
  const LasCrs crs = readLasCrs(file, places);
  header.Crs = crs.Text;
  header.HasUnknownCrs = crs.IsUnknown;
  return header;
}

} // namespace tipp
