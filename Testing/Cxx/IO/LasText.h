// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasText_h
#define tippLasText_h

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace test
{

/// Makes a LAS file in memory, by the specification.
class LasText
{
public:
  LasText(int minor, int format)
    : Format(format)
    , Header(minor >= 5 ? 393
          : minor == 4  ? 375
          : minor == 3  ? 235
                        : 227)
  {
    std::memcpy(this->Header.data(), "LASF", 4);
    this->header(24, std::uint8_t(1));
    this->header(25, std::uint8_t(minor));
    this->header(94, std::uint16_t(this->Header.size()));
    this->header(96, std::uint32_t(this->Header.size()));
    this->header(104, std::uint8_t(format));
    this->header(105, std::uint16_t(this->length()));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->header(131 + 8 * axis, 0.01);
      this->header(155 + 8 * axis, 100.0 * double(axis));
    }
  }

  template <typename T>
  void header(std::size_t at, T value)
  {
    std::memcpy(this->Header.data() + at, &value, sizeof(T));
  }

  std::size_t length() const
  {
    constexpr std::size_t lengths[] = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67 };
    return lengths[this->Format] + 3; // each format has three extra bytes
  }
  bool isExtended() const { return this->Format >= 6; }

  void add(int x, int y, int z, int number, int flags = 0, int returnNumber = 1, int returns = 1)
  {
    std::vector<char> record(this->length(), 'e');
    const auto put = [&](std::size_t at, auto value)
    { std::memcpy(record.data() + at, &value, sizeof(value)); };
    put(0, std::int32_t(x));
    put(4, std::int32_t(y));
    put(8, std::int32_t(z));
    put(12, std::uint16_t(70));
    const bool wide = this->isExtended();
    put(14, std::uint8_t(returnNumber | (returns << (wide ? 4 : 3))));
    put(15, std::uint8_t(wide ? flags : number | (flags << 5)));
    if (wide)
    {
      put(16, std::uint8_t(number));
    }
    const std::size_t basics = wide ? 22 : 20;
    const bool timed = this->Format == 1 || this->Format >= 3;
    if (timed)
    {
      put(basics, 1.5);
    }
    const std::size_t colour = basics + (timed ? 8 : 0);
    for (std::size_t i = 0; i < 4 && colour + 2 * i + 2 <= record.size(); ++i)
    {
      put(colour + 2 * i, std::uint16_t(1000 + i));
    }
    this->Records.append(record.data(), record.size());
    ++this->Count;
  }

  std::string text()
  {
    this->header(107, std::uint32_t(this->isExtended() ? 0 : this->Count));
    if (this->Header.size() >= 375)
    {
      this->header(247, std::uint64_t(this->Count));
    }
    return std::string(this->Header.data(), this->Header.size()) + this->Between + this->Records;
  }

  /// Adds a variable length record before the points.
  void addRecord(int id, const std::string& content)
  {
    std::string record(54, '\0');
    record.replace(2, 15, "LASF_Projection");
    record[18] = char(id & 255);
    record[19] = char(id >> 8);
    record[20] = char(content.size() & 255);
    record[21] = char(content.size() >> 8);
    this->addBytes(record + content);
    this->header(100, ++this->RecordCount);
  }

  /// Adds bytes before the points.
  void addBytes(const std::string& bytes)
  {
    this->Between += bytes;
    this->header(96, std::uint32_t(this->Header.size() + this->Between.size()));
  }

private:
  int Format;
  std::vector<char> Header;
  std::string Between;
  std::string Records;
  std::uint32_t RecordCount = 0;
  std::size_t Count = 0;
};

/// A GeoTIFF key directory with these keys and values.
inline std::string keysOf(const std::vector<std::pair<int, int>>& keys)
{
  std::vector<std::uint16_t> numbers = { 1, 1, 0, std::uint16_t(keys.size()) };
  for (const auto& [key, value] : keys)
  {
    numbers.insert(numbers.end(), { std::uint16_t(key), 0, 1, std::uint16_t(value) });
  }
  return { reinterpret_cast<const char*>(numbers.data()), 2 * numbers.size() };
}

} // namespace test
} // namespace tipp

#endif
