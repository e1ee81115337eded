// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasRecords.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"

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

#ifndef TIPP_HAVE_LASZIP
std::unique_ptr<LasRecords> openLazRecords(const std::string& path, const LasHeader&)
{
  throw IOError(path,
    "is compressed (LAZ), and this program was built without LASzip; install liblaszip-dev and "
    "build it again, or decompress the file, as with 'pdal translate in.laz out.las'.");
}
#endif

} // namespace tipp
