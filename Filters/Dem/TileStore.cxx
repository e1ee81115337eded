// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/TileStore.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <type_traits>

#include <fcntl.h>
#include <unistd.h>

namespace tipp
{
namespace
{

constexpr std::int64_t tilePixels = RasterTileSize * RasterTileSize;

/// NaNs that no computation makes.
constexpr std::uint64_t missingOf(std::uint64_t)
{
  return 0xfff8dead00000000u;
}
constexpr std::uint32_t missingOf(std::uint32_t)
{
  return 0xffc0deadu;
}

template <typename Word>
using NumberOf = std::conditional_t<sizeof(Word) == sizeof(float), float, double>;

/// What is stored of a value: 0, as in the holes of a file, for a pixel that has none.
template <typename Word>
Word encode(double value)
{
  const auto number = NumberOf<Word>(value);
  Word bits;
  std::memcpy(&bits, &number, sizeof bits);
  return bits ^ missingOf(Word());
}

template <typename Word>
double decode(Word stored)
{
  const Word bits = stored ^ missingOf(Word());
  NumberOf<Word> number;
  std::memcpy(&number, &bits, sizeof number);
  return stored == 0 ? std::numeric_limits<double>::quiet_NaN() : double(number);
}

} // namespace

TileStore::TileStore(
  const std::string& path, const RasterGrid& grid, std::size_t bands, bool isSingle)
  : Path(path)
  , Grid(grid)
  , Bands(bands)
  , IsSingle(isSingle)
  , Descriptor(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))
{
  if (this->Descriptor < 0)
  {
    failToWrite(path);
  }
}

TileStore::~TileStore()
{
  close(this->Descriptor);
}

/// Tiles are counted from the north-west, so that each has the rows of a tile of the raster's file;
/// in a tile rows are those from the north.
template <typename Word>
std::uint64_t TileStore::offset(std::int64_t column, std::int64_t row, std::size_t band) const
{
  const std::int64_t fromNorth = this->Grid.Rows - 1 - row;
  const std::int64_t across = (this->Grid.Columns + RasterTileSize - 1) / RasterTileSize;
  const std::int64_t tile = fromNorth / RasterTileSize * across + column / RasterTileSize;
  const std::int64_t pixel = fromNorth % RasterTileSize * RasterTileSize + column % RasterTileSize;
  return sizeof(Word) *
    ((std::uint64_t(tile) * this->Bands + band) * tilePixels + std::uint64_t(pixel));
}

/// Keeps other threads and processes away from the tile of a pixel.
template <typename Word>
class TileStore::Lock
{
public:
  Lock(const TileStore& store, std::int64_t column, std::int64_t row)
    : Store(store)
    , Begin(store.template offset<Word>(column / RasterTileSize * RasterTileSize,
        store.Grid.Rows - 1 - (store.Grid.Rows - 1 - row) / RasterTileSize * RasterTileSize, 0))
    , Length(sizeof(Word) * std::uint64_t(tilePixels) * store.Bands)
    , Thread(store.Mutexes[this->Begin / this->Length % store.Mutexes.size()])
  {
    if (!this->setFileLock(F_WRLCK))
    {
      failToWrite(store.Path);
    }
  }
  ~Lock() { this->setFileLock(F_UNLCK); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

private:
  bool setFileLock(short type) const
  {
    struct flock lock = {};
    lock.l_type = type;
    lock.l_whence = SEEK_SET;
    lock.l_start = off_t(this->Begin);
    lock.l_len = off_t(this->Length);
    int result = 0;
    do
    {
      result = fcntl(this->Store.Descriptor, F_SETLKW, &lock);
    } while (result < 0 && errno == EINTR);
    return result == 0;
  }

  const TileStore& Store;
  const std::uint64_t Begin;
  const std::uint64_t Length;
  const std::lock_guard<std::mutex> Thread;
};

/// What lies beyond the end of the file is 0.
void TileStore::readAt(std::uint64_t offset, void* words, std::size_t bytes) const
{
  auto* at = static_cast<char*>(words);
  while (bytes > 0)
  {
    const ssize_t got = pread(this->Descriptor, at, bytes, off_t(offset));
    if (got < 0 && errno == EINTR)
    {
      continue;
    }
    if (got < 0)
    {
      throw IOError(this->Path, std::string("cannot be read (") + std::strerror(errno) + ").");
    }
    if (got == 0)
    {
      std::memset(at, 0, bytes);
      return;
    }
    at += got;
    offset += std::uint64_t(got);
    bytes -= std::size_t(got);
  }
}

void TileStore::writeAt(std::uint64_t offset, const void* words, std::size_t bytes) const
{
  const auto* at = static_cast<const char*>(words);
  while (bytes > 0)
  {
    const ssize_t put = pwrite(this->Descriptor, at, bytes, off_t(offset));
    if (put < 0 && errno == EINTR)
    {
      continue;
    }
    if (put < 0)
    {
      failToWrite(this->Path);
    }
    at += put;
    offset += std::uint64_t(put);
    bytes -= std::size_t(put);
  }
}

template <typename Word>
void TileStore::setAs(const RasterWindow& window, const std::vector<unsigned char>& isSet,
  const std::vector<std::vector<double>>& values)
{
  const Lock<Word> lock(*this, window.Column, window.Row);
  const auto width = std::size_t(window.Columns);
  // Its rows lie one after the other, the northernmost first.
  std::vector<Word> rows(std::size_t(window.Rows - 1) * std::size_t(RasterTileSize) + width);
  for (std::size_t band = 0; band < this->Bands; ++band)
  {
    const std::uint64_t at = this->offset<Word>(window.Column, window.Row + window.Rows - 1, band);
    this->readAt(at, rows.data(), rows.size() * sizeof(Word));
    for (std::size_t row = 0; row < std::size_t(window.Rows); ++row)
    {
      Word* const to =
        rows.data() + (std::size_t(window.Rows) - 1 - row) * std::size_t(RasterTileSize);
      for (std::size_t i = 0; i < width; ++i)
      {
        to[i] = isSet[row * width + i] != 0 ? encode<Word>(values[band][row * width + i]) : to[i];
      }
    }
    this->writeAt(at, rows.data(), rows.size() * sizeof(Word));
  }
}

template <typename Word>
void TileStore::setIfMissingAs(std::int64_t pixel, const double* values)
{
  const std::int64_t column = pixel % this->Grid.Columns;
  const std::int64_t row = pixel / this->Grid.Columns;
  const Lock<Word> lock(*this, column, row);
  Word first = 0;
  this->readAt(this->offset<Word>(column, row, 0), &first, sizeof first);
  for (std::size_t band = 0; first == 0 && band < this->Bands; ++band)
  {
    const auto word = encode<Word>(values[band]);
    this->writeAt(this->offset<Word>(column, row, band), &word, sizeof word);
  }
}

template <typename Word>
void TileStore::readAs(const RasterWindow& tile, std::vector<std::vector<double>>& values) const
{
  const Lock<Word> lock(*this, tile.Column, tile.Row);
  const auto width = std::size_t(tile.Columns);
  std::vector<Word> words(width);
  values.resize(this->Bands);
  for (std::size_t band = 0; band < this->Bands; ++band)
  {
    values[band].resize(width * std::size_t(tile.Rows));
    for (std::int64_t row = 0; row < tile.Rows; ++row)
    {
      this->readAt(
        this->offset<Word>(tile.Column, tile.Row + row, band), words.data(), width * sizeof(Word));
      std::transform(words.begin(), words.end(),
        values[band].begin() + std::ptrdiff_t(std::size_t(row) * width), decode<Word>);
    }
  }
}

void TileStore::set(const RasterWindow& window, const std::vector<unsigned char>& isSet,
  const std::vector<std::vector<double>>& values)
{
  this->IsSingle ? this->setAs<std::uint32_t>(window, isSet, values)
                 : this->setAs<std::uint64_t>(window, isSet, values);
}

void TileStore::setIfMissing(std::int64_t pixel, const double* values)
{
  this->IsSingle ? this->setIfMissingAs<std::uint32_t>(pixel, values)
                 : this->setIfMissingAs<std::uint64_t>(pixel, values);
}

void TileStore::read(const RasterWindow& tile, std::vector<std::vector<double>>& values) const
{
  this->IsSingle ? this->readAs<std::uint32_t>(tile, values)
                 : this->readAs<std::uint64_t>(tile, values);
}

} // namespace tipp
