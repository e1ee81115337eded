// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/TiledTiff.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#ifdef TIPP_HAVE_LIBDEFLATE
#include <libdeflate.h>
#endif

namespace tipp
{
namespace
{

/// Room for the header of a BigTIFF; that of a TIFF has half the size.
constexpr std::uint64_t headerSize = 16;

/// A tile in the order in which floating-point numbers compress best, TIFF's predictor 3: of each
/// row the first bytes of all numbers, then the second ones, and of these the differences.
std::string predicted(const std::string& pixels, std::size_t valueSize)
{
  constexpr auto width = std::size_t(RasterTileSize);
  const std::size_t rowSize = width * valueSize;
  std::string bytes(pixels.size(), '\0');
  for (std::size_t row = 0; row < pixels.size(); row += rowSize)
  {
    const char* const from = pixels.data() + row;
    char* const to = bytes.data() + row;
    for (std::size_t byte = 0; byte < valueSize; ++byte)
    {
      char* const plane = to + (valueSize - 1 - byte) * width;
      for (std::size_t i = 0; i < width; ++i)
      {
        plane[i] = from[i * valueSize + byte];
      }
    }
    for (std::size_t i = rowSize - 1; i > 0; --i)
    {
      to[i] = static_cast<char>(
        static_cast<unsigned char>(to[i]) - static_cast<unsigned char>(to[i - 1]));
    }
  }
  return bytes;
}

#ifdef TIPP_HAVE_LIBDEFLATE
struct FreeCompressor
{
  void operator()(libdeflate_compressor* compressor) const
  {
    libdeflate_free_compressor(compressor);
  }
};

std::string deflated(const std::string& bytes)
{
  // Higher levels take twice the time for a few per cent.
  thread_local const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
    libdeflate_alloc_compressor(1));
  if (!compressor)
  {
    throw std::bad_alloc();
  }
  std::string result(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  result.resize(libdeflate_zlib_compress(
    compressor.get(), bytes.data(), bytes.size(), result.data(), result.size()));
  result.shrink_to_fit(); // it may wait for its turn
  return result;
}
#else
std::string deflated(const std::string&)
{
  throw std::logic_error("tiles are deflated without libdeflate");
}
#endif

std::size_t sizeOf(TiffField::Type type)
{
  switch (type)
  {
    case TiffField::Type::Text:
      return 1;
    case TiffField::Type::Short:
      return 2;
    case TiffField::Type::Long:
      return 4;
    case TiffField::Type::Double:
    case TiffField::Type::Long8:
      break;
  }
  return 8;
}

template <typename T>
void append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Offsets and counts have 32 bits in a TIFF, 64 in a BigTIFF.
void appendWord(std::string& bytes, std::uint64_t value, bool isBig)
{
  isBig ? append(bytes, value) : append(bytes, std::uint32_t(value));
}

/// The directory at `at` in the file and, behind it, the values that do not fit into its entries.
std::string directory(const std::vector<TiffField>& fields, std::uint64_t at, bool isBig)
{
  const std::size_t word = isBig ? 8 : 4;
  const std::uint64_t entries = fields.size() * (4 + 2 * word);
  std::uint64_t end = at + (isBig ? 8 : 2) + entries + word;
  std::string bytes;
  std::string values;
  isBig ? append(bytes, std::uint64_t(fields.size())) : append(bytes, std::uint16_t(fields.size()));
  for (const TiffField& field : fields)
  {
    append(bytes, field.Tag);
    append(bytes, static_cast<std::uint16_t>(field.Is));
    appendWord(bytes, field.Bytes.size() / sizeOf(field.Is), isBig);
    if (field.Bytes.size() <= word)
    {
      bytes += field.Bytes + std::string(word - field.Bytes.size(), '\0');
      continue;
    }
    appendWord(bytes, end, isBig);
    const std::string padded = field.Bytes + std::string(field.Bytes.size() % 2, '\0');
    values += padded;
    end += padded.size();
  }
  appendWord(bytes, 0, isBig); // no further directory
  return bytes + values;
}

} // namespace

bool canDeflateTiles()
{
#ifdef TIPP_HAVE_LIBDEFLATE
  return true;
#else
  return false;
#endif
}

std::string deflateTile(const std::string& pixels, std::size_t valueSize)
{
  return deflated(predicted(pixels, valueSize));
}

TiledTiff::TiledTiff(const OutputFile& file, const RasterGrid& grid, std::size_t bands,
  bool isDouble, bool isDeflated, std::uint64_t classicBytes)
  : File(file)
  , Grid(grid)
  , IsDouble(isDouble)
  , IsDeflated(isDeflated)
  , ClassicBytes(classicBytes)
  , End(headerSize)
  , Bands(bands)
{
}

void TiledTiff::append(std::size_t band, const std::string& tile)
{
  this->File.write(this->End, tile.data(), tile.size());
  this->Bands[band].Offsets.push_back(this->End);
  this->Bands[band].Sizes.push_back(tile.size());
  this->End += tile.size();
}

std::vector<TiffField> TiledTiff::pixelFields() const
{
  using Type = TiffField::Type;
  using Short = std::uint16_t;
  using Long = std::uint32_t;
  const std::size_t bands = this->Bands.size();
  const auto repeated = [bands](int value) { return std::vector<Short>(bands, Short(value)); };
  const auto one = [](int value) { return std::vector<Short>{ Short(value) }; };
  std::vector<TiffField> fields = {
    tiffField(256, Type::Long, std::vector<Long>{ Long(this->Grid.Columns) }),
    tiffField(257, Type::Long, std::vector<Long>{ Long(this->Grid.Rows) }),
    tiffField(258, Type::Short, repeated(this->IsDouble ? 64 : 32)), // bits
    tiffField(259, Type::Short, one(this->IsDeflated ? 8 : 1)),      // compression
    tiffField(262, Type::Short, one(1)),                             // 0 is black
    tiffField(277, Type::Short, one(int(bands))),                    // values a pixel
    tiffField(284, Type::Short, one(bands > 1 ? 2 : 1)),             // bands by themselves
    tiffField(322, Type::Short, one(int(RasterTileSize))),
    tiffField(323, Type::Short, one(int(RasterTileSize))),
    tiffField(339, Type::Short, repeated(3)), // floating-point numbers
  };
  if (this->IsDeflated)
  {
    fields.push_back(tiffField(317, Type::Short, one(3))); // predictor
  }
  if (bands > 1)
  {
    fields.push_back(tiffField(338, Type::Short, std::vector<Short>(bands - 1, 0))); // no alpha
  }
  return fields;
}

void TiledTiff::finish(std::vector<TiffField> fields)
{
  const std::vector<TiffField> ofPixels = this->pixelFields();
  fields.insert(fields.end(), ofPixels.begin(), ofPixels.end());
  std::vector<std::uint64_t> offsets;
  std::vector<std::uint64_t> sizes;
  std::uint64_t other = 0;
  for (const Band& band : this->Bands)
  {
    offsets.insert(offsets.end(), band.Offsets.begin(), band.Offsets.end());
    sizes.insert(sizes.end(), band.Sizes.begin(), band.Sizes.end());
  }
  for (const TiffField& field : fields)
  {
    other += field.Bytes.size() + 32;
  }
  this->End += this->End % 2;
  const bool isBig = this->End + 16 * offsets.size() + other + 1024 > this->ClassicBytes;
  const auto addWords = [&](std::uint16_t tag, const std::vector<std::uint64_t>& words)
  {
    fields.push_back(isBig ? tiffField(tag, TiffField::Type::Long8, words)
                           : tiffField(tag, TiffField::Type::Long,
                               std::vector<std::uint32_t>(words.begin(), words.end())));
  };
  addWords(324, offsets);
  addWords(325, sizes);
  std::sort(fields.begin(), fields.end(),
    [](const TiffField& a, const TiffField& b) { return a.Tag < b.Tag; });
  const std::string bytes = directory(fields, this->End, isBig);
  this->File.write(this->End, bytes.data(), bytes.size());
  std::string header = "II";
  tipp::append(header, std::uint16_t(isBig ? 43 : 42));
  if (isBig)
  {
    tipp::append(header, std::uint16_t(8));
    tipp::append(header, std::uint16_t(0));
  }
  appendWord(header, this->End, isBig);
  header.resize(headerSize, '\0');
  this->File.write(0, header.data(), header.size());
}

} // namespace tipp
