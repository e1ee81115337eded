// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"
#include "Parallel/ParallelFor.h"
#include "Raster/Overviews.h"
#include "Raster/RasterFile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

#ifdef TIPP_HAVE_LIBDEFLATE
#include <libdeflate.h>
#endif

namespace tipp
{
namespace
{

/// Bytes reserved for the header: the size for a BigTIFF; a TIFF header takes half of it.
constexpr std::uint64_t headerSize = 16;

/// Applies TIFF's predictor 3, which makes floating-point tiles compress well: in each row the most
/// significant bytes of all numbers, then the next bytes and so on, and of these the differences.
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
constexpr bool canDeflate = true;

struct FreeCompressor
{
  void operator()(libdeflate_compressor* compressor) const
  {
    libdeflate_free_compressor(compressor);
  }
};

std::string deflated(const std::string& bytes)
{
  // Higher levels take twice the time and gain a few per cent.
  thread_local const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
    libdeflate_alloc_compressor(1));
  if (!compressor)
  {
    throw std::bad_alloc();
  }
  std::string result(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  result.resize(libdeflate_zlib_compress(
    compressor.get(), bytes.data(), bytes.size(), result.data(), result.size()));
  result.shrink_to_fit(); // the tile may be kept until earlier ones are written
  return result;
}
#else
constexpr bool canDeflate = false;

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
void appendNumber(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Appends an offset or count, which has 32 bits in a TIFF and 64 in a BigTIFF.
void appendWord(std::string& bytes, std::uint64_t value, bool isBig)
{
  isBig ? appendNumber(bytes, value) : appendNumber(bytes, std::uint32_t(value));
}

/// Returns the directory, to be written at offset `at`, followed by the values that do not fit into
/// its entries. The next directory, if there is one, must follow at once.
std::string directory(
  const std::vector<TiffField>& fields, std::uint64_t at, bool isBig, bool isLast)
{
  const std::size_t word = isBig ? 8 : 4;
  const std::uint64_t entries = fields.size() * (4 + 2 * word);
  std::uint64_t end = at + (isBig ? 8 : 2) + entries + word;
  std::string bytes;
  std::string values;
  isBig ? appendNumber(bytes, std::uint64_t(fields.size()))
        : appendNumber(bytes, std::uint16_t(fields.size()));
  for (const TiffField& field : fields)
  {
    appendNumber(bytes, field.Tag);
    appendNumber(bytes, static_cast<std::uint16_t>(field.Is));
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
  appendWord(bytes, isLast ? 0 : end, isBig);
  return bytes + values;
}

template <typename T>
TiffField tiffField(std::uint16_t tag, TiffField::Type type, const std::vector<T>& values)
{
  return { tag, type,
    std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)) };
}

/// Whether GDAL converts the file from an uncompressed one.
bool isConverted(const RasterDescription& description)
{
  return !(
    description.Compression == "none" || (description.Compression == "deflate" && canDeflate));
}

/// Whether tiles are first stored uncompressed in another file: for GDAL, or for overviews.
bool hasPlain(const RasterDescription& description)
{
  return isConverted(description) || description.CloudOptimized;
}

bool isDeflated(const RasterDescription& description)
{
  return !isConverted(description) && description.Compression == "deflate";
}

std::size_t valueSize(const RasterDescription& description)
{
  return description.Double ? sizeof(double) : sizeof(float);
}

/// Returns the bytes that a file that GDAL does not convert has for a tile of these pixels.
std::string packed(const RasterDescription& description, std::string pixels)
{
  return isDeflated(description) ? deflated(predicted(pixels, valueSize(description)))
                                 : std::move(pixels);
}

/// The text behind the header that says that directories come first, as GDAL's driver COG writes
/// it. Its first line gives the size of the others.
std::string layoutText()
{
  const std::string lines =
    "LAYOUT=IFDS_BEFORE_DATA\nBLOCK_ORDER=ROW_MAJOR\nBLOCK_LEADER=SIZE_AS_UINT4\n"
    "BLOCK_TRAILER=LAST_4_BYTES_REPEATED\nKNOWN_INCOMPATIBLE_EDITION=NO\n ";
  const std::string size = std::to_string(lines.size());
  return "GDAL_STRUCTURAL_METADATA_SIZE=" + std::string(6 - size.size(), '0') + size + " bytes\n" +
    lines;
}

/// Returns the header of a file whose first directory is at this offset.
std::string headerText(bool isBig, std::uint64_t first)
{
  std::string header = "II";
  appendNumber(header, std::uint16_t(isBig ? 43 : 42));
  if (isBig)
  {
    appendNumber(header, std::uint16_t(8));
    appendNumber(header, std::uint16_t(0));
  }
  appendWord(header, first, isBig);
  return header;
}

TiffField textField(std::uint16_t tag, const std::string& text)
{
  return { tag, TiffField::Type::Text, text + '\0' };
}

/// Encodes a band of a tile. Pixels beyond the raster's border have no data.
template <typename T>
EncodedTile::Band encodeBand(const RasterDescription& description, const RasterWindow& window,
  const double* values, const std::string& name)
{
  constexpr auto side = std::size_t(RasterTileSize);
  const T noData = T(description.NoData);
  std::string bytes(side * side * sizeof(T), '\0');
  T* const pixels = reinterpret_cast<T*>(bytes.data());
  std::fill(pixels, pixels + side * side, noData);
  EncodedTile::Band band;
  for (std::int64_t row = 0; row < window.Rows; ++row)
  {
    const double* const from = values + row * window.Columns;
    T* const to = pixels + std::size_t(window.Rows - 1 - row) * side;
    for (std::int64_t i = 0; i < window.Columns; ++i)
    {
      if (!std::isnan(from[i]))
      {
        to[i] = T(from[i]);
        if (std::isinf(to[i]) && sizeof(T) < sizeof(double))
        {
          requireSingle(from[i], name);
        }
        if (to[i] == noData)
        {
          band.Sums.Hidden += 1;
        }
        else
        {
          band.Sums.add(double(to[i]));
        }
      }
    }
  }
  band.Bytes = hasPlain(description) ? std::move(bytes) : packed(description, std::move(bytes));
  return band;
}

/// Writes a TIFF file of floating-point bands, each in its own tiles, from the north-west on.
/// Compresses tiles in the calling threads and appends them to the file in order. The file becomes
/// a BigTIFF if it may exceed ClassicBytes of the description.
class GeoTiffWriter : public RasterWriter
{
public:
  GeoTiffWriter(
    const std::string& path, const RasterDescription& description, const PathState& before)
    : Path(path)
    , Description(description)
    , Pending(path, before)
    , Bands(description.Bands.size())
  {
    requireGeoTiff(description, path);
    if (hasPlain(description))
    {
      this->Plain = std::make_unique<PendingFile>(path + ".plain");
    }
    if (!description.Crs.empty())
    {
      this->Keys = geoKeysOf(description.Crs);
    }
  }

  void write(const RasterWindow& window, const std::vector<const double*>& bands) override
  {
    this->writeEncoded(
      tileNumber(this->Description.Grid, window), encodeTile(this->Description, window, bands));
  }

  void writeEncoded(std::int64_t tile, EncodedTile encoded) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Waiting.emplace(tile, std::move(encoded));
    while (!this->Waiting.empty() && this->Waiting.begin()->first == this->Written)
    {
      const EncodedTile& next = this->Waiting.begin()->second;
      for (std::size_t band = 0; band < next.Bands.size(); ++band)
      {
        this->append(this->Bands[band], next.Bands[band].Bytes);
        this->Bands[band].Sums.add(next.Bands[band].Sums);
      }
      this->Waiting.erase(this->Waiting.begin());
      ++this->Written;
    }
  }

  void close() override
  {
    if (this->Description.CloudOptimized)
    {
      this->addOverviews();
    }
    if (!isConverted(this->Description) && this->Description.CloudOptimized)
    {
      this->layOut();
    }
    else
    {
      this->finish();
    }
    if (isConverted(this->Description))
    {
      convertGeoTiff(
        this->Plain->temporaryPath(), this->Pending.temporaryPath(), this->Description, this->Path);
    }
    this->Pending.commit();
  }

  double hidden() const override
  {
    return std::accumulate(this->Bands.begin(), this->Bands.end(), 0.0,
      [](double sum, const Band& band) { return sum + band.Sums.Hidden; });
  }

private:
  /// The tiles of a band so far.
  struct Band
  {
    std::vector<std::uint64_t> Offsets;
    std::vector<std::uint64_t> Sizes;
    BandSums Sums;
  };

  /// The raster or one of its overviews, which a directory of the file describes.
  struct Level
  {
    OverviewSize Size;
    std::vector<Band> Bands;
  };

  const OutputFile& file() const { return (this->Plain ? *this->Plain : this->Pending).file(); }

  /// Appends the next tile of a band: RasterTileSize rows of RasterTileSize values of the file's
  /// type, northernmost row first; for a deflated file, predicted and deflated. Throws IOError.
  void append(Band& band, const std::string& tile)
  {
    band.Offsets.push_back(this->append(tile));
    band.Sizes.push_back(tile.size());
  }

  /// Returns the offset.
  std::uint64_t append(const std::string& tile)
  {
    const std::uint64_t offset = this->End;
    this->file().write(offset, tile.data(), tile.size());
    this->End += tile.size();
    return offset;
  }

  /// Adds the overviews, from the uncompressed tiles in the file. Throws IOError.
  void addOverviews()
  {
    const std::vector<OverviewSize> sizes = overviewSizes(this->Description.Grid);
    for (std::size_t level = 1; level < sizes.size(); ++level)
    {
      Band empty;
      empty.Offsets.resize(std::size_t(sizes[level].tiles()));
      empty.Sizes.resize(empty.Offsets.size());
      this->Overviews.push_back({ sizes[level], std::vector<Band>(this->Bands.size(), empty) });
    }
    const InputFile file(this->Plain->temporaryPath());
    for (std::size_t i = 0; i < this->Bands.size(); ++i)
    {
      OverviewTiles tiles;
      tiles.Read = [&](std::int64_t tile)
      {
        std::string bytes(this->Bands[i].Sizes[std::size_t(tile)], '\0');
        file.read(this->Bands[i].Offsets[std::size_t(tile)], bytes.data(), bytes.size());
        return this->Description.Double ? pixelsOf<double>(bytes) : pixelsOf<float>(bytes);
      };
      tiles.Write = [&](std::size_t level, std::int64_t tile, const TilePixels& pixels)
      {
        const std::string bytes =
          this->Description.Double ? bytesOf<double>(pixels) : bytesOf<float>(pixels);
        Band& band = this->Overviews[level - 1].Bands[i];
        band.Offsets[std::size_t(tile)] = this->append(bytes);
        band.Sizes[std::size_t(tile)] = bytes.size();
      };
      const std::vector<OverviewRule>& rules = this->Description.Overviews;
      makeOverviews(sizes, i < rules.size() ? rules[i] : OverviewRule::Mean, tiles);
    }
  }

  /// The values of an uncompressed tile.
  template <typename T>
  TilePixels pixelsOf(const std::string& bytes) const
  {
    const T noData = T(this->Description.NoData);
    TilePixels pixels(bytes.size() / sizeof(T));
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
      T value;
      std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
      pixels[i] = value == noData ? std::numeric_limits<double>::quiet_NaN() : double(value);
    }
    return pixels;
  }

  template <typename T>
  std::string bytesOf(const TilePixels& pixels) const
  {
    std::string bytes;
    bytes.reserve(pixels.size() * sizeof(T));
    for (const double pixel : pixels)
    {
      appendNumber(bytes, T(std::isnan(pixel) ? this->Description.NoData : pixel));
    }
    return bytes;
  }

  /// Returns the raster and its overviews.
  std::vector<Level> levels() const
  {
    const RasterGrid& grid = this->Description.Grid;
    std::vector<Level> levels = { { { grid.Columns, grid.Rows }, this->Bands } };
    levels.insert(levels.end(), this->Overviews.begin(), this->Overviews.end());
    return levels;
  }

  /// Returns the directories of the levels, to be written at offset `at`.
  std::string directoriesOf(const std::vector<Level>& levels, std::uint64_t at, bool isBig) const
  {
    std::string bytes;
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
      std::vector<TiffField> fields;
      this->addPixelFields(fields, levels[i].Size);
      i == 0 ? this->addFields(fields) : addOverviewField(fields);
      addOffsets(levels[i], isBig, fields);
      std::sort(fields.begin(), fields.end(),
        [](const TiffField& a, const TiffField& b) { return a.Tag < b.Tag; });
      bytes += directory(fields, at + bytes.size(), isBig, i + 1 == levels.size());
    }
    return bytes;
  }

  /// Completes the file with the directories. Throws IOError.
  void finish()
  {
    this->End += this->End % 2;
    const std::vector<Level> levels = this->levels();
    const bool isBig = this->End + this->directoriesOf(levels, this->End, true).size() >
      this->Description.ClassicBytes;
    std::string header = headerText(isBig, this->End);
    header.resize(headerSize, '\0');
    this->append(this->directoriesOf(levels, this->End, isBig));
    this->file().write(0, header.data(), header.size());
  }

  /// Writes the file from the uncompressed tiles in the order for readers over a network: the
  /// directories, the smallest overview ... the raster. Throws IOError.
  void layOut()
  {
    std::vector<Level> levels = this->levels();
    const std::string text = layoutText();
    // A deflated tile is at most a few bytes larger.
    const std::uint64_t most = this->End + this->End / 1000 + text.size() +
      this->directoriesOf(levels, 0, true).size() + headerSize;
    const bool isBig = most > this->Description.ClassicBytes;
    std::string start = headerText(isBig, 0);
    std::uint64_t first = start.size() + text.size();
    first += first % 2;
    start = headerText(isBig, first) + text;
    start.resize(std::size_t(first), '\0');
    // The size of the directories does not depend on the offsets in them.
    std::uint64_t end = first + this->directoriesOf(levels, first, isBig).size();
    const InputFile plain(this->Plain->temporaryPath());
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    {
      for (Band& band : level->Bands)
      {
        end = this->packTiles(plain, band, end);
      }
    }
    start += this->directoriesOf(levels, first, isBig);
    this->Pending.file().write(0, start.data(), start.size());
  }

  /// Writes a band's tiles from the offset `end` on, and replaces their offsets and sizes. Returns
  /// the offset after them.
  std::uint64_t packTiles(const InputFile& plain, Band& band, std::uint64_t end) const
  {
    const int threads = threadCount(this->Description.Threads);
    const std::size_t most = 4 * std::size_t(threads); // tiles in memory
    for (std::size_t first = 0; first < band.Offsets.size(); first += most)
    {
      std::vector<std::string> tiles(std::min(most, band.Offsets.size() - first));
      const auto pack = [&](std::int64_t begin, std::int64_t last, int)
      {
        for (auto i = std::size_t(begin); i < std::size_t(last); ++i)
        {
          std::string pixels(std::size_t(band.Sizes[first + i]), '\0');
          plain.read(band.Offsets[first + i], pixels.data(), pixels.size());
          tiles[i] = packed(this->Description, std::move(pixels));
        }
      };
      forChunks(std::int64_t(tiles.size()), 1, threads, {}, pack);
      for (std::size_t i = 0; i < tiles.size(); ++i)
      {
        // As layoutText() says: the size before the tile, and its last four bytes again after it.
        std::string block;
        appendNumber(block, std::uint32_t(tiles[i].size()));
        band.Offsets[first + i] = end + block.size();
        band.Sizes[first + i] = tiles[i].size();
        block += tiles[i] + tiles[i].substr(tiles[i].size() - 4);
        this->Pending.file().write(end, block.data(), block.size());
        end += block.size();
      }
    }
    return end;
  }

  /// Adds where the tiles are.
  static void addOffsets(const Level& level, bool isBig, std::vector<TiffField>& fields)
  {
    std::vector<std::uint64_t> offsets;
    std::vector<std::uint64_t> sizes;
    for (const Band& band : level.Bands)
    {
      offsets.insert(offsets.end(), band.Offsets.begin(), band.Offsets.end());
      sizes.insert(sizes.end(), band.Sizes.begin(), band.Sizes.end());
    }
    const auto addWords = [&](std::uint16_t tag, const std::vector<std::uint64_t>& words)
    {
      fields.push_back(isBig ? tiffField(tag, TiffField::Type::Long8, words)
                             : tiffField(tag, TiffField::Type::Long,
                                 std::vector<std::uint32_t>(words.begin(), words.end())));
    };
    addWords(324, offsets);
    addWords(325, sizes);
  }

  static void addOverviewField(std::vector<TiffField>& fields)
  {
    fields.push_back(
      tiffField(254, TiffField::Type::Long, std::vector<std::uint32_t>{ 1 })); // reduced resolution
  }

  void addPixelFields(std::vector<TiffField>& fields, const OverviewSize& size) const
  {
    using Type = TiffField::Type;
    using Short = std::uint16_t;
    using Long = std::uint32_t;
    const std::size_t bands = this->Bands.size();
    const bool deflates = isDeflated(this->Description);
    const auto repeated = [bands](int value) { return std::vector<Short>(bands, Short(value)); };
    const auto one = [](int value) { return std::vector<Short>{ Short(value) }; };
    fields.insert(fields.end(),
      {
        tiffField(256, Type::Long, std::vector<Long>{ Long(size.Columns) }),
        tiffField(257, Type::Long, std::vector<Long>{ Long(size.Rows) }),
        tiffField(258, Type::Short, repeated(this->Description.Double ? 64 : 32)), // bits
        tiffField(259, Type::Short, one(deflates ? 8 : 1)),                        // compression
        tiffField(262, Type::Short, one(1)),                                       // 0 is black
        tiffField(277, Type::Short, one(int(bands))),        // samples per pixel
        tiffField(284, Type::Short, one(bands > 1 ? 2 : 1)), // bands stored separately
        tiffField(322, Type::Short, one(int(RasterTileSize))),
        tiffField(323, Type::Short, one(int(RasterTileSize))),
        tiffField(339, Type::Short, repeated(3)), // floating-point numbers
        textField(42113, exactText(this->storedNoData())),
      });
    if (deflates)
    {
      fields.push_back(tiffField(317, Type::Short, one(3))); // predictor
    }
    if (bands > 1)
    {
      fields.push_back(tiffField(338, Type::Short, std::vector<Short>(bands - 1, 0))); // no alpha
    }
  }

  /// The number that pixels without data have.
  double storedNoData() const
  {
    const double number = this->Description.NoData;
    return this->Description.Double ? number : double(float(number));
  }

  /// Adds georeferencing, the reference system, band names and statistics as GDAL reads them.
  void addFields(std::vector<TiffField>& fields) const
  {
    using Type = TiffField::Type;
    const RasterGrid& grid = this->Description.Grid;
    fields.push_back(
      tiffField(33550, Type::Double, std::vector<double>{ grid.Pixel[0], grid.Pixel[1], 0 }));
    fields.push_back(
      tiffField(33922, Type::Double, std::vector<double>{ 0, 0, 0, grid.West, grid.north(), 0 }));
    fields.push_back(textField(42112, this->metadata()));
    fields.insert(fields.end(), this->Keys.begin(), this->Keys.end());
  }

  std::string metadata() const
  {
    std::string text = "<GDALMetadata>\n";
    for (std::size_t band = 0; band < this->Bands.size(); ++band)
    {
      const auto add = [&](const char* name, const std::string& value, const char* more = "")
      {
        text += std::string("  <Item name=\"") + name + "\" sample=\"" + std::to_string(band) +
          "\"" + more + ">" + value + "</Item>\n";
      };
      add("DESCRIPTION", escapedXml(this->Description.Bands[band]), " role=\"description\"");
      const BandSums& sums = this->Bands[band].Sums;
      if (sums.Count > 0)
      {
        add("STATISTICS_MAXIMUM", exactText(sums.Most));
        add("STATISTICS_MEAN", exactText(sums.Mean));
        add("STATISTICS_MINIMUM", exactText(sums.Least));
        add("STATISTICS_STDDEV", exactText(sums.deviation()));
      }
    }
    return text + "</GDALMetadata>\n";
  }

  const std::string Path;
  const RasterDescription Description;
  PendingFile Pending;
  std::unique_ptr<PendingFile> Plain;          ///< the uncompressed tiles, if hasPlain()
  std::vector<TiffField> Keys;                 ///< fields of the reference system
  std::mutex Mutex;                            ///< guards the members below
  std::map<std::int64_t, EncodedTile> Waiting; ///< waiting for earlier tiles
  std::int64_t Written = 0;                    ///< tiles
  std::uint64_t End = headerSize;              ///< end of the written data
  std::vector<Band> Bands;
  std::vector<Level> Overviews;
};

} // namespace

EncodedTile encodeTile(const RasterDescription& description, const RasterWindow& window,
  const std::vector<const double*>& bands)
{
  EncodedTile tile;
  for (std::size_t i = 0; i < bands.size(); ++i)
  {
    const std::string name = i < description.Bands.size() ? description.Bands[i] : "";
    tile.Bands.push_back(description.Double
        ? encodeBand<double>(description, window, bands[i], name)
        : encodeBand<float>(description, window, bands[i], name));
  }
  return tile;
}

void requireSingle(double value, const std::string& band)
{
  if (std::isfinite(value) && std::isinf(float(value)))
  {
    throw IOError("The value " + exactText(value) + " of the band '" + band +
      "' is too large for 32 bits; give --type float64.");
  }
}

void requireGeoTiff(const RasterDescription& description, const std::string& path)
{
  if (isConverted(description))
  {
    requireConversion(description, path);
  }
}

std::unique_ptr<RasterWriter> createGeoTiff(
  const std::string& path, const RasterDescription& description, const PathState& before)
{
  return std::make_unique<GeoTiffWriter>(path, description, before);
}

} // namespace tipp
