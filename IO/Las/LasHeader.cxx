// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasHeader.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#ifdef TIPP_HAVE_LASZIP
#include <laszip/laszip_api.h>
#endif

namespace tipp
{
namespace
{

std::vector<char> readBytes(const InputFile& file, std::uint64_t offset, std::size_t size)
{
  std::vector<char> bytes(size);
  file.read(offset, bytes.data(), size);
  return bytes;
}

/// Finds the coordinate reference system in variable length records. Damaged records count as
/// absent, since the points can be read without them.
class CrsFinder
{
public:
  explicit CrsFinder(const InputFile& file)
    : File(file)
  {
  }

  /// Searches `count` records in the bytes [at, end); `wide`: their lengths have 64 bits.
  void search(std::uint64_t at, std::uint64_t end, std::uint32_t count, bool wide)
  {
    const std::size_t header = wide ? 60 : 54; // bytes before a record's content
    constexpr std::uint64_t longest = std::uint64_t(1) << 24;
    for (std::uint32_t i = 0; i < count && at <= end && end - at >= header; ++i)
    {
      const std::vector<char> bytes = readBytes(this->File, at, header);
      const std::uint64_t length =
        wide ? valueAt<std::uint64_t>(&bytes[20]) : valueAt<std::uint16_t>(&bytes[20]);
      at += header;
      if (length > end - at)
      {
        return;
      }
      const auto record = valueAt<std::uint16_t>(&bytes[18]);
      const bool isProjection = std::memcmp(bytes.data() + 2, "LASF_Projection", 16) == 0 ||
        (std::memcmp(bytes.data() + 2, "liblas", 7) == 0 && record == wkt);
      if (isProjection && length <= longest)
      {
        this->take(record, readBytes(this->File, at, std::size_t(length)));
      }
      at += length;
    }
  }

  CrsRecords take() { return std::move(this->Found); }

private:
  static constexpr int wkt = 2112;

  void take(int record, const std::vector<char>& content)
  {
    std::string* const slot = record == wkt ? &this->Found.Text
      : record == 34735                     ? &this->Found.Keys
      : record == 34736                     ? &this->Found.Doubles
      : record == 34737                     ? &this->Found.Ascii
                                            : nullptr;
    if (slot)
    {
      slot->assign(content.begin(), content.end());
    }
    if (record == wkt) // ends at the first null byte
    {
      slot->resize(std::min(slot->find('\0'), slot->size()));
    }
  }

  const InputFile& File;
  CrsRecords Found;
};

constexpr std::size_t shortHeader = 227; ///< header size of versions 1.0 to 1.2
constexpr std::size_t longHeader = 375;  ///< header size of version 1.4; that of 1.5 is longer

/// The least number of bytes of a record, by format.
constexpr std::array<std::size_t, 11> recordLengths = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59,
  67 };

void requireGood(bool condition, const std::string& path, const std::string& problem)
{
  if (!condition)
  {
    throw IOError(path, problem + "; copy it again.");
  }
}

void readFormat(const std::vector<char>& fields, const std::string& path, LasHeader& header)
{
  const int format = valueAt<std::uint8_t>(&fields[104]);
  header.Compressed = (format & 0xC0) != 0;
  header.Format = format & 0x3F;
  header.RecordLength = valueAt<std::uint16_t>(&fields[105]);
  if (std::size_t(header.Format) >= recordLengths.size())
  {
    throw IOError(path,
      "has points of format " + std::to_string(header.Format) +
        ", which is not known here; write it with one of the formats 0 to 10.");
  }
  const std::size_t least = recordLengths[std::size_t(header.Format)];
  requireGood(header.RecordLength >= least, path,
    "gives " + std::to_string(header.RecordLength) + " bytes for a point of format " +
      std::to_string(header.Format) + ", which has " + std::to_string(least));
}

void readTransform(const std::vector<char>& fields, const std::string& path, LasHeader& header)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    header.Scale[axis] = valueAt<double>(&fields[131 + 8 * axis]);
    header.Offset[axis] = valueAt<double>(&fields[155 + 8 * axis]);
    requireGood(std::isfinite(header.Scale[axis]) && header.Scale[axis] != 0 &&
        std::isfinite(header.Offset[axis]),
      path, std::string("has no usable scale or offset of ") + "xyz"[axis] + " in its header");
  }
}

/// Returns the number of points that the header announces. Version 1.4 has a count of 64 bits,
/// which some programs leave 0 beside the older one.
std::uint64_t announcedCount(const std::vector<char>& fields, int minor)
{
  const std::uint64_t older = valueAt<std::uint32_t>(&fields[107]);
  const std::uint64_t count = minor >= 4 ? valueAt<std::uint64_t>(&fields[247]) : 0;
  return count > 0 ? count : older;
}

/// Returns where the point records end at the latest, in bytes: where the waveforms (since version
/// 1.3) or the extended variable length records (since 1.4) begin, or the file ends.
std::uint64_t endOfPoints(
  const std::vector<char>& fields, const LasHeader& header, std::uint64_t fileSize)
{
  constexpr std::size_t waveforms = 227;
  constexpr std::size_t records = 235;
  std::uint64_t end = fileSize;
  const auto endAt = [&](std::size_t field, int minor)
  {
    const bool isThere = header.Minor >= minor && fields.size() >= field + sizeof(std::uint64_t);
    const std::uint64_t begin = isThere ? valueAt<std::uint64_t>(&fields[field]) : 0;
    end = begin > header.PointOffset ? std::min(end, begin) : end;
  };
  endAt(waveforms, 3);
  endAt(records, 4);
  return end;
}

std::string pointsOf(std::uint64_t count)
{
  return std::to_string(count) + (count == 1 ? " point" : " points");
}

void readCount(const std::vector<char>& fields, const std::string& path, std::uint64_t fileSize,
  std::size_t headerSize, const LasSelection& selection, LasHeader& header)
{
  const std::uint64_t count = announcedCount(fields, header.Minor);
  header.PointOffset = valueAt<std::uint32_t>(&fields[96]);
  requireGood(header.PointOffset >= headerSize && header.PointOffset <= fileSize, path,
    "has its points at byte " + std::to_string(header.PointOffset) +
      " by its header, where there is no room for them");
  header.Points = std::int64_t(count);
  if (header.Compressed)
  {
    requireGood(count < (std::uint64_t(1) << 48), path, "announces " + pointsOf(count));
    return;
  }
  const std::uint64_t room = (fileSize - header.PointOffset) / header.RecordLength;
  const std::uint64_t whole =
    (endOfPoints(fields, header, fileSize) - header.PointOffset) / header.RecordLength;
  if (count > room)
  {
    const std::string problem =
      "announces " + pointsOf(count) + " and ends after " + std::to_string(room);
    if (!selection.KeepTruncated)
    {
      throw IOError(
        path, problem + "; copy it again, or read the points that it has with --keep truncated.");
    }
    header.Points = std::int64_t(room);
    header.Remark = problem + ", which are read";
  }
  else if (count < whole)
  {
    const std::string problem =
      "announces " + pointsOf(count) + " and has room for " + std::to_string(whole);
    header.Points = std::int64_t(selection.KeepUncounted ? whole : count);
    header.Remark = problem +
      (selection.KeepUncounted ? ", which are read"
                               : "; the others are not read, except with --keep uncounted");
  }
}

} // namespace

LasHeader readLasHeader(const std::string& path)
{
  return readLasHeader(path, {});
}

LasHeader readLasHeader(const std::string& path, const LasSelection& selection)
{
  const InputFile file(path);
  requireGood(file.size() >= shortHeader, path, "is too short for a LAS file");
  const std::vector<char> start = readBytes(file, 0, shortHeader);
  requireGood(std::memcmp(start.data(), "LASF", 4) == 0, path, "is not a LAS file");
  LasHeader header;
  const int major = valueAt<std::uint8_t>(&start[24]);
  header.Minor = valueAt<std::uint8_t>(&start[25]);
  if (major != 1 || header.Minor > 5)
  {
    throw IOError(path,
      "is a LAS file of version " + std::to_string(major) + "." + std::to_string(header.Minor) +
        ", which is not known here; write it as version 1.0 to 1.5.");
  }
  const std::size_t size = valueAt<std::uint16_t>(&start[94]);
  const std::size_t least = header.Minor >= 4 ? longHeader : shortHeader;
  requireGood(size >= least && size <= file.size(), path,
    "has a header of " + std::to_string(size) + " bytes, too few or too many");
  const std::vector<char> fields = readBytes(file, 0, std::min(size, longHeader));
  readFormat(fields, path, header);
  readTransform(fields, path, header);
  readCount(fields, path, file.size(), size, selection, header);
  CrsFinder finder(file);
  finder.search(
    size, std::min(header.PointOffset, file.size()), valueAt<std::uint32_t>(&fields[100]), false);
  const std::uint64_t extended = header.Minor >= 4 ? valueAt<std::uint64_t>(&fields[235]) : 0;
  if (extended > 0)
  {
    finder.search(extended, file.size(), valueAt<std::uint32_t>(&fields[243]), true);
  }
  header.Crs = finder.take();
  return header;
}

namespace
{

class PlainRecords : public LasRecords
{
public:
  PlainRecords(const std::string& path, std::uint64_t begin, std::size_t length)
    : File(path)
    , Begin(begin)
    , Length(length)
  {
  }

  void read(std::int64_t first, std::size_t count, char* records) override
  {
    this->File.read(
      this->Begin + std::uint64_t(first) * this->Length, records, count * this->Length);
  }

private:
  InputFile File;
  const std::uint64_t Begin;
  const std::size_t Length;
};

#ifdef TIPP_HAVE_LASZIP

template <typename T>
void put(char* record, std::size_t offset, T value)
{
  std::memcpy(record + offset, &value, sizeof(T));
}

/// LASzip's point as a record of the file's format; wave packets and extra bytes are left out.
void encode(const laszip_point& point, const LasHeader& header, char* record)
{
  put(record, 0, point.X);
  put(record, 4, point.Y);
  put(record, 8, point.Z);
  put(record, 12, point.intensity);
  std::size_t time = 20;
  std::size_t colour = header.hasTime() ? 28 : 20;
  if (header.isExtended())
  {
    const unsigned returns =
      (point.extended_return_number & 15U) | (unsigned(point.extended_number_of_returns) << 4);
    put(record, 14, std::uint8_t(returns));
    put(record, 15, std::uint8_t(point.extended_classification_flags & 15U));
    put(record, 16, point.extended_classification);
    time = 22;
    colour = 30;
  }
  else
  {
    const unsigned returns = (point.return_number & 7U) | (unsigned(point.number_of_returns) << 3);
    const unsigned flags = (unsigned(point.synthetic_flag) << 5) |
      (unsigned(point.keypoint_flag) << 6) | (unsigned(point.withheld_flag) << 7);
    put(record, 14, std::uint8_t(returns & 63U));
    put(record, 15, std::uint8_t((point.classification & 31U) | flags));
  }
  if (header.hasTime())
  {
    put(record, time, point.gps_time);
  }
  if (header.hasColour())
  {
    const std::size_t colours = header.hasInfrared() ? 4 : 3;
    std::memcpy(record + colour, point.rgb, 2 * colours);
  }
}

class CompressedRecords : public LasRecords
{
public:
  CompressedRecords(const std::string& path, const LasHeader& header)
    : Path(path)
    , Header(header)
  {
    laszip_BOOL isCompressed = 0;
    this->check(laszip_create(&this->Reader) == 0);
    if (laszip_open_reader(this->Reader, path.c_str(), &isCompressed) != 0 ||
      laszip_get_point_pointer(this->Reader, &this->Point) != 0)
    {
      laszip_destroy(this->Reader);
      this->check(false);
    }
  }
  ~CompressedRecords() override
  {
    laszip_close_reader(this->Reader);
    laszip_destroy(this->Reader);
  }
  CompressedRecords(const CompressedRecords&) = delete;
  CompressedRecords& operator=(const CompressedRecords&) = delete;

  void read(std::int64_t first, std::size_t count, char* records) override
  {
    if (first != this->At)
    {
      this->check(laszip_seek_point(this->Reader, first) == 0);
      this->At = first;
    }
    for (std::size_t i = 0; i < count; ++i, ++this->At)
    {
      this->check(laszip_read_point(this->Reader) == 0);
      encode(*this->Point, this->Header, records + i * this->Header.RecordLength);
    }
  }

private:
  void check(bool good) const
  {
    if (!good)
    {
      throw IOError(this->Path,
        "cannot be decompressed after point " + std::to_string(this->At) +
          "; copy it again, or read the points before it with --keep truncated.");
    }
  }

  const std::string Path;
  const LasHeader Header;
  laszip_POINTER Reader = nullptr;
  laszip_point* Point = nullptr;
  std::int64_t At = 0;
};

#endif

} // namespace

std::unique_ptr<LasRecords> openLasRecords(const std::string& path, const LasHeader& header)
{
  if (!header.Compressed)
  {
    return std::make_unique<PlainRecords>(path, header.PointOffset, header.RecordLength);
  }
#ifdef TIPP_HAVE_LASZIP
  return std::make_unique<CompressedRecords>(path, header);
#else
  const std::string name = std::filesystem::path(path).filename().string();
  throw IOError(path,
    "is compressed (LAZ), which needs LASzip, and this tipp was built without it; decompress the "
    "file, as with 'pdal translate " +
      name + " " + name.substr(0, name.rfind('.')) + ".las', or in Python with laspy and lazrs.");
#endif
}

} // namespace tipp
