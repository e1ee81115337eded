// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasHeader.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tipp
{
namespace
{

/// The least number of bytes of a record, by format.
constexpr std::array<std::size_t, 11> recordLengths = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59,
  67 };

std::vector<char> readBytes(const InputFile& file, std::uint64_t offset, std::size_t size)
{
  std::vector<char> bytes(size);
  file.read(offset, bytes.data(), size);
  return bytes;
}

/// Splits the bytes of a record from `begin` to `end` as the descriptions say. Bytes that none
/// describes are the last.
std::vector<LasExtra> extrasOf(const std::string& descriptors, std::size_t begin, std::size_t end)
{
  constexpr std::array<std::size_t, 11> sizes = { 0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8 };
  constexpr std::size_t types = sizes.size() - 1;
  std::vector<LasExtra> extras;
  for (std::size_t at = 0; descriptors.size() - at >= LasExtra::DescriptorSize;
       at += LasExtra::DescriptorSize)
  {
    // Arrays of two and three values have the numbers after those of single values.
    const std::size_t type = std::uint8_t(descriptors[at + 2]);
    const std::size_t size = type == 0 ? std::uint8_t(descriptors[at + 3])
      : type <= 3 * types              ? sizes[(type - 1) % types + 1] * ((type - 1) / types + 1)
                                       : 0;
    if (size == 0 || size > end - begin)
    {
      break;
    }
    extras.push_back({ descriptors.substr(at, LasExtra::DescriptorSize), size, begin });
    begin += size;
  }
  if (begin < end)
  {
    extras.push_back({ "", end - begin, begin });
  }
  return extras;
}

/// Finds the coordinate reference system, the compression, and what tells where points are, in
/// variable length records. Damaged records count as absent, since points that are not compressed
/// can be read without them.
class RecordFinder
{
public:
  RecordFinder(const InputFile& file, LasHeader& found)
    : File(file)
    , Found(found)
  {
  }

  /// Searches `count` records in the bytes [at, end); `wide`: their lengths have 64 bits.
  void search(std::uint64_t at, std::uint64_t end, std::uint32_t count, bool wide)
  {
    const std::size_t header = wide ? 60 : 54; // bytes before a record's content
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
      this->take(bytes, at, length, wide);
      at += length;
    }
  }

  /// The descriptions of extra bytes, one after the other.
  const std::string& descriptors() const { return this->Descriptors; }

private:
  static constexpr int extraBytes = 4;
  static constexpr int wkt = 2112;
  static constexpr int laz = 22204;
  static constexpr int copc = 1;
  static constexpr int index = 30;

  /// Takes what is of interest in a record, whose header is `header`, and whose content begins at
  /// `at`.
  void take(const std::vector<char>& header, std::uint64_t at, std::uint64_t length, bool wide)
  {
    constexpr std::uint64_t longest = std::uint64_t(1) << 24;
    const auto record = valueAt<std::uint16_t>(&header[18]);
    const auto isOf = [&header](const char* user)
    { return std::memcmp(header.data() + 2, user, std::strlen(user) + 1) == 0; };
    const auto content = [&]
    {
      const std::vector<char> bytes =
        readBytes(this->File, at, std::size_t(length <= longest ? length : 0));
      return std::string(bytes.begin(), bytes.end());
    };
    if (isOf("LASF_Projection") || (isOf("liblas") && record == wkt))
    {
      this->takeCrs(record, content());
    }
    else if (isOf("laszip encoded") && record == laz)
    {
      this->Found.Compression = wide ? this->Found.Compression : content();
    }
    else if (isOf("copc"))
    {
      this->Found.Copc = record == copc && !wide ? content() : this->Found.Copc;
    }
    else if (isOf("LAStools") && record == index)
    {
      this->Found.IndexOffset = at;
      this->Found.IndexBytes = length;
    }
    else if (isOf("LASF_Spec") && record == extraBytes)
    {
      this->Descriptors += content(); // some writers give each its own record
    }
    else
    {
      ++this->Found.OtherRecords;
    }
  }

  void takeCrs(int record, const std::string& content)
  {
    CrsRecords& found = this->Found.Crs;
    std::string* const slot = record == wkt ? &found.Text
      : record == 34735                     ? &found.Keys
      : record == 34736                     ? &found.Doubles
      : record == 34737                     ? &found.Ascii
                                            : nullptr;
    if (slot)
    {
      *slot = content;
    }
    if (record == wkt) // ends at the first null byte
    {
      slot->resize(std::min(slot->find('\0'), slot->size()));
    }
  }

  const InputFile& File;
  LasHeader& Found;
  std::string Descriptors;
};

constexpr std::size_t shortHeader = 227; ///< header size of versions 1.0 to 1.2
constexpr std::size_t longHeader = 375;  ///< header size of version 1.4; that of 1.5 is longer

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
  const std::size_t least = lasRecordLength(header.Format);
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

void readBounds(const std::vector<char>& fields, LasHeader& header)
{
  Box2 box;
  bool isZero = true;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const auto high = valueAt<double>(&fields[179 + 16 * axis]);
    const auto low = valueAt<double>(&fields[187 + 16 * axis]);
    isZero = isZero && low == 0 && high == 0;
    // Coordinates are multiples of the scale; some programs round the bounds differently.
    const double slack =
      std::fabs(header.Scale[axis]) + 1e-14 * std::max(std::fabs(low), std::fabs(high));
    box.Min[axis] = low - slack;
    box.Max[axis] = low <= high ? high + slack : std::nan("");
  }
  header.Bounds = isFinite(box) && !isZero ? box : Box2::empty();
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

std::size_t lasRecordLength(int format)
{
  return recordLengths[std::size_t(format)];
}

std::string LasExtra::name() const
{
  constexpr std::size_t begin = 4;
  constexpr std::size_t longest = 32;
  return this->Descriptor.empty() ? std::string()
                                  : std::string(this->Descriptor.substr(begin, longest).c_str());
}

std::string LasExtra::descriptorWithoutRange() const
{
  constexpr std::size_t options = 3;
  constexpr unsigned isRangeThere = 2 | 4;
  constexpr std::size_t range = 64;
  constexpr std::size_t rangeBytes = 48;
  std::string descriptor = this->Descriptor;
  if (!descriptor.empty() && descriptor[2] != 0) // bytes of type 0 have no options
  {
    descriptor[options] = char(std::uint8_t(descriptor[options]) & ~isRangeThere);
    descriptor.replace(range, rangeBytes, rangeBytes, '\0');
  }
  return descriptor;
}

std::string LasExtra::key() const
{
  if (this->Descriptor.empty())
  {
    return std::to_string(this->Size);
  }
  constexpr std::size_t type = 2;
  constexpr std::size_t text = 160; // for people
  const std::string key = this->descriptorWithoutRange();
  return key.substr(type, text - type);
}

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
  header.Encoding = valueAt<std::uint16_t>(&fields[6]);
  header.System = std::string(&fields[26], 32).c_str();
  readFormat(fields, path, header);
  readTransform(fields, path, header);
  readCount(fields, path, file.size(), size, selection, header);
  // Points beyond the announced ones need not lie in the header's bounds.
  if (!selection.KeepUncounted || header.Remark.empty())
  {
    readBounds(fields, header);
  }
  RecordFinder finder(file, header);
  finder.search(
    size, std::min(header.PointOffset, file.size()), valueAt<std::uint32_t>(&fields[100]), false);
  const std::uint64_t extended = header.Minor >= 4 ? valueAt<std::uint64_t>(&fields[235]) : 0;
  if (extended > 0)
  {
    finder.search(extended, file.size(), valueAt<std::uint32_t>(&fields[243]), true);
  }
  // LASzip names records of its own in that of the compression.
  if (header.Compression.size() >= 32)
  {
    const auto count = valueAt<std::int64_t>(&header.Compression[16]);
    const auto offset = valueAt<std::int64_t>(&header.Compression[24]);
    constexpr std::int64_t many = 1000;
    if (count > 0 && offset > 0)
    {
      finder.search(std::uint64_t(offset), file.size(), std::uint32_t(std::min(count, many)), true);
    }
  }
  header.Extras =
    extrasOf(finder.descriptors(), lasRecordLength(header.Format), header.RecordLength);
  if (!header.Compressed) // a hierarchy has the chunks of a LAZ file
  {
    header.Copc.clear();
  }
  return header;
}

} // namespace tipp
