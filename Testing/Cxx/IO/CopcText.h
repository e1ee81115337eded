// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCopcText_h
#define tippCopcText_h

#include "LasText.h"
#include "LazText.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace tipp::test
{

/// Makes a COPC file in memory. Each node has a single point, which LAZ does not compress. The
/// nodes from level 3 on are in pages of their own. There is no table of chunks, since that would
/// be compressed; readers find the chunks one after the other.
class CopcText
{
public:
  using Key = std::array<std::int32_t, 4>;      ///< level, and the position along x, y and z
  static constexpr std::int32_t Side = 1 << 20; ///< of the octree's cube, from 0, in steps
  static constexpr int PagedLevel = 3;

  /// Adds a point, with coordinates from 0 to below Side that no other point has. A coordinate is
  /// 0.01 of it, plus 100 for y and 200 for z, as in LasText.
  void add(std::int32_t x, std::int32_t y, std::int32_t z, int number = 2)
  {
    Key key{};
    while (this->Points.count(key) > 0)
    {
      ++key[0];
      const std::int32_t side = Side >> key[0];
      key = { key[0], x / side, y / side, z / side };
    }
    this->Points[key] = { x, y, z, number };
  }

  std::string text()
  {
    LasText las(4, 6);
    las.header(104, std::uint8_t(128 + 6));
    las.header(105, std::uint16_t(recordLength));
    las.addBytes(record("copc", 1, std::string(160, '\0')));
    std::string compression = textOfDigits(lazInputs[6].Record);
    putAt(compression, 12, ~std::uint32_t(0)); // chunks of different sizes
    las.addBytes(record("laszip encoded", 22204, compression));
    las.header(100, std::uint32_t(2));
    std::string text = las.text();
    putCount(text, 6, this->Points.size());
    text.append(8, '\0'); // no table of chunks
    std::map<Key, std::vector<std::string>> pages;
    for (const auto& [key, point] : this->Points)
    {
      pages[pageOf(key)].push_back(entry(key, text.size(), chunkBytes, 1));
      text += chunkOf(point);
    }
    putAt(text, 235, std::uint64_t(text.size()));
    putAt(text, 243, std::uint32_t(1));
    this->writePages(text, pages);
    putBounds(text);
    return text;
  }

  /// Where the pages are, in bytes, after text().
  std::map<Key, std::size_t> PageOffsets;
  std::map<Key, std::size_t> PageBytes;

  /// Offsets of the members of the record 'info'.
  static constexpr std::size_t Info = 375 + 54;
  static constexpr std::size_t RootOffset = Info + 40;
  static constexpr std::size_t RootBytes = Info + 48;

  static constexpr std::size_t EntryBytes = 32;
  static std::string entry(
    const Key& key, std::uint64_t offset, std::int32_t bytes, std::int32_t points)
  {
    std::string text(EntryBytes, '\0');
    for (std::size_t i = 0; i < 4; ++i)
    {
      putAt(text, 4 * i, key[i]);
    }
    putAt(text, 16, offset);
    putAt(text, 24, bytes);
    putAt(text, 28, points);
    return text;
  }

private:
  static constexpr std::size_t recordLength = 32;
  static constexpr std::int32_t chunkBytes = 32 + 4 + 11 * 4;

  static std::string record(const std::string& user, int id, const std::string& content)
  {
    std::string text(54, '\0');
    text.replace(2, user.size(), user);
    putAt(text, 18, std::uint16_t(id));
    putAt(text, 20, std::uint16_t(content.size()));
    return text + content;
  }

  static Key pageOf(const Key& key)
  {
    if (key[0] < PagedLevel)
    {
      return {};
    }
    const int up = key[0] - PagedLevel;
    return { PagedLevel, key[1] >> up, key[2] >> up, key[3] >> up };
  }

  static std::string chunkOf(const std::array<int, 4>& point)
  {
    std::string text(chunkBytes, '\0');
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      putAt(text, 4 * axis, std::int32_t(point[axis]));
    }
    text[14] = 0x11; // the first return of one
    text[16] = char(point[3]);
    putAt(text, recordLength, std::uint32_t(1)); // points of the chunk
    return text;
  }

  void writePages(std::string& text, const std::map<Key, std::vector<std::string>>& pages)
  {
    std::size_t bytes = (pages.size() - 1) * EntryBytes;
    for (const auto& [key, entries] : pages)
    {
      bytes += entries.size() * EntryBytes;
    }
    std::string header(60, '\0');
    header.replace(2, 4, "copc");
    putAt(header, 18, std::uint16_t(1000));
    putAt(header, 20, std::uint64_t(bytes));
    text += header;
    for (auto page = pages.rbegin(); page != pages.rend(); ++page) // the root's is the last
    {
      this->PageOffsets[page->first] = text.size();
      for (const std::string& entry : page->second)
      {
        text += entry;
      }
      for (const auto& [key, offset] : this->PageOffsets)
      {
        text += page->first == Key{} && key != Key{}
          ? entry(key, offset, std::int32_t(this->PageBytes[key]), -1)
          : "";
      }
      this->PageBytes[page->first] = text.size() - this->PageOffsets[page->first];
    }
    const double half = 0.005 * Side;
    const std::array<double, 5> info = { half, half + 100, half + 200, half, 0.01 * Side / 128 };
    std::memcpy(&text[Info], info.data(), sizeof info);
    putAt(text, RootOffset, std::uint64_t(this->PageOffsets[Key{}]));
    putAt(text, RootBytes, std::uint64_t(this->PageBytes[Key{}]));
  }

  void putBounds(std::string& text) const
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      double low = 1e300;
      double high = -1e300;
      for (const auto& [key, point] : this->Points)
      {
        const double at = 0.01 * point[axis] + 100.0 * double(axis);
        low = at < low ? at : low;
        high = at > high ? at : high;
      }
      putAt(text, 179 + 16 * axis, high);
      putAt(text, 187 + 16 * axis, low);
    }
  }

  std::map<Key, std::array<int, 4>> Points; ///< x, y, z and class
};

} // namespace tipp::test

#endif
