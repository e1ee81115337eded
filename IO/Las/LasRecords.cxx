// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasHeader.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"

#ifdef TIPP_HAVE_LASZIP
#include <laszip/laszip_api.h>
#endif

#include <cstring>

namespace tipp
{
namespace
{

class PlainRecords : public LasRecords
{
public:
  PlainRecords(const std::string& path, const LasHeader& header)
    : File(path)
    , Begin(header.PointOffset)
    , Length(header.RecordLength)
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

} // namespace

std::unique_ptr<LasRecords> openLasRecords(const std::string& path, const LasHeader& header)
{
  return header.Compressed ? openLazRecords(path, header)
                           : std::make_unique<PlainRecords>(path, header);
}

#ifdef TIPP_HAVE_LASZIP

namespace
{

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
        "cannot be decompressed after point " + std::to_string(this->At) + "; copy it again.");
    }
  }

  const std::string Path;
  const LasHeader Header;
  laszip_POINTER Reader = nullptr;
  laszip_point* Point = nullptr;
  std::int64_t At = 0;
};

} // namespace

std::unique_ptr<LasRecords> openLazRecords(const std::string& path, const LasHeader& header)
{
  return std::make_unique<CompressedRecords>(path, header);
}

#else

std::unique_ptr<LasRecords> openLazRecords(const std::string& path, const LasHeader&)
{
  throw IOError(path,
    "is compressed (LAZ), and this program was built without LASzip; install liblaszip-dev and "
    "build it again, or decompress the file, as with 'pdal translate in.laz out.las'.");
}

#endif

} // namespace tipp
