// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasCrs.h"

#include "Files/InputFile.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace tipp
{
namespace
{

template <typename T>
T valueAt(const std::vector<char>& bytes, std::size_t offset)
{
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

std::vector<char> readBytes(const InputFile& file, std::uint64_t offset, std::size_t size)
{
  std::vector<char> bytes(size);
  file.read(offset, bytes.data(), size);
  return bytes;
}

class CrsFinder
{
public:
  explicit CrsFinder(const InputFile& file)
    : File(file)
  {
  }

  /// `header`: bytes before a record's content; `wide`: its length has 64 bits.
  void search(std::uint64_t at, std::uint64_t end, std::uint32_t count, bool wide)
  {
    const std::size_t header = wide ? 60 : 54;
    constexpr std::uint64_t longest = std::uint64_t(1) << 24;
    for (std::uint32_t i = 0; i < count && at <= end && end - at >= header; ++i)
    {
      const std::vector<char> bytes = readBytes(this->File, at, header);
      const std::uint64_t length =
        wide ? valueAt<std::uint64_t>(bytes, 20) : valueAt<std::uint16_t>(bytes, 20);
      at += header;
      if (length > end - at)
      {
        return;
      }
      const bool isProjection = std::strncmp(bytes.data() + 2, "LASF_Projection", 16) == 0;
      if (isProjection && length <= longest)
      {
        this->take(
          valueAt<std::uint16_t>(bytes, 18), readBytes(this->File, at, std::size_t(length)));
      }
      at += length;
    }
  }

  /// WKT is what later versions write, beside keys perhaps.
  LasCrs result() const
  {
    if (!this->Wkt.empty())
    {
      return { this->Wkt, false };
    }
    const int horizontal = this->Projected > 0 ? this->Projected : this->Geographic;
    if (horizontal <= 0)
    {
      return { "", this->HasKeys };
    }
    const std::string vertical =
      this->Vertical > 0 ? "+" + std::to_string(this->Vertical) : std::string();
    return { "EPSG:" + std::to_string(horizontal) + vertical, false };
  }

private:
  void take(int record, const std::vector<char>& content)
  {
    constexpr int wkt = 2112;
    constexpr int keys = 34735;
    if (record == wkt)
    {
      this->Wkt.assign(content.begin(), std::find(content.begin(), content.end(), '\0'));
    }
    if (record == keys)
    {
      this->takeKeys(content);
    }
  }

  /// GeoTIFF's key directory: four numbers of 16 bits each; of a key its id, where its value is (0:
  /// in place), how many, and the value.
  void takeKeys(const std::vector<char>& content)
  {
    constexpr int userDefined = 32767;
    const std::size_t entries = content.size() / 8;
    for (std::size_t i = 1; i < entries; ++i)
    {
      const auto number = [&](std::size_t j)
      { return int(valueAt<std::uint16_t>(content, 8 * i + 2 * j)); };
      if (number(1) != 0 || number(3) == 0)
      {
        continue;
      }
      const int code = number(3) == userDefined ? -1 : number(3);
      int* const slot = number(0) == 3072 ? &this->Projected
        : number(0) == 2048               ? &this->Geographic
        : number(0) == 4096               ? &this->Vertical
                                          : nullptr;
      if (slot)
      {
        *slot = code;
        this->HasKeys = true;
      }
    }
    // A projection of its own stands on a geographic system that is not the points'.
    this->Geographic = this->Projected < 0 ? -1 : this->Geographic;
  }

  const InputFile& File;
  std::string Wkt;
  int Projected = 0; ///< 0: none; -1: not an EPSG code
  int Geographic = 0;
  int Vertical = 0;
  bool HasKeys = false;
};

} // namespace

LasCrs readLasCrs(const InputFile& file, const LasRecordPlaces& places)
{
  CrsFinder finder(file);
  finder.search(places.Begin, std::min(places.End, file.size()), places.Count, false);
  if (places.ExtendedBegin > 0)
  {
    finder.search(places.ExtendedBegin, file.size(), places.ExtendedCount, true);
  }
  return finder.result();
}

} // namespace tipp
