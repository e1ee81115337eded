// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/TileStore.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include <fcntl.h>
#include <unistd.h>

namespace tipp
{
namespace
{

constexpr std::int64_t tilePixels = RasterTileSize * RasterTileSize;

/// What is stored of a value: 0, as in the holes of a file, for a pixel that has none.
std::uint64_t encode(double value)
{
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  constexpr std::uint64_t missing = 0xfff8dead00000000u; // a NaN that no computation makes
  return bits ^ missing;
}

double decode(std::uint64_t stored)
{
  constexpr std::uint64_t missing = 0xfff8dead00000000u;
  const std::uint64_t bits = stored ^ missing;
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return stored == 0 ? std::numeric_limits<double>::quiet_NaN() : value;
}

} // namespace

TileStore::TileStore(const std::string& path, const RasterGrid& grid, std::size_t bands)
  : Path(path)
  , Grid(grid)
  , Bands(bands)
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
std::uint64_t TileStore::offset(std::int64_t column, std::int64_t row, std::size_t band) const
{
  const std::int64_t fromNorth = this->Grid.Rows - 1 - row;
  const std::int64_t across = (this->Grid.Columns + RasterTileSize - 1) / RasterTileSize;
  const std::int64_t tile = fromNorth / RasterTileSize * across + column / RasterTileSize;
  const std::int64_t pixel = fromNorth % RasterTileSize * RasterTileSize + column % RasterTileSize;
  return sizeof(std::uint64_t) *
    ((std::uint64_t(tile) * this->Bands + band) * tilePixels + std::uint64_t(pixel));
}

/// Keeps other threads and processes away from the tile of a pixel.
class TileStore::Lock
{
public:
  Lock(const TileStore& store, std::int64_t column, std::int64_t row)
    : Store(store)
    , Begin(store.offset(column / RasterTileSize * RasterTileSize,
        store.Grid.Rows - 1 - (store.Grid.Rows - 1 - row) / RasterTileSize * RasterTileSize, 0))
    , Length(sizeof(double) * std::uint64_t(tilePixels) * store.Bands)
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

/// As stored; what lies beyond the end of the file is 0.
void TileStore::readAt(std::uint64_t offset, double* values, std::size_t count) const
{
  auto* at = reinterpret_cast<char*>(values);
  std::size_t left = sizeof(double) * count;
  while (left > 0)
  {
    const ssize_t got = pread(this->Descriptor, at, left, off_t(offset));
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
      std::memset(at, 0, left);
      return;
    }
    at += got;
    offset += std::uint64_t(got);
    left -= std::size_t(got);
  }
}

void TileStore::writeAt(std::uint64_t offset, const double* values, std::size_t count) const
{
  const auto* at = reinterpret_cast<const char*>(values);
  std::size_t left = sizeof(double) * count;
  while (left > 0)
  {
    const ssize_t put = pwrite(this->Descriptor, at, left, off_t(offset));
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
    left -= std::size_t(put);
  }
}

void TileStore::set(const RasterWindow& window, const std::vector<unsigned char>& isSet,
  const std::vector<std::vector<double>>& values)
{
  const Lock lock(*this, window.Column, window.Row);
  const auto width = std::size_t(window.Columns);
  // Its rows lie one after the other, the northernmost first.
  const std::size_t stored = std::size_t(window.Rows - 1) * std::size_t(RasterTileSize) + width;
  std::vector<double> rows(stored);
  for (std::size_t band = 0; band < this->Bands; ++band)
  {
    const std::uint64_t at = this->offset(window.Column, window.Row + window.Rows - 1, band);
    this->readAt(at, rows.data(), stored);
    for (std::size_t row = 0; row < std::size_t(window.Rows); ++row)
    {
      double* const to =
        rows.data() + (std::size_t(window.Rows) - 1 - row) * std::size_t(RasterTileSize);
      for (std::size_t i = 0; i < width; ++i)
      {
        if (isSet[row * width + i] != 0)
        {
          const std::uint64_t bits = encode(values[band][row * width + i]);
          std::memcpy(to + i, &bits, sizeof bits);
        }
      }
    }
    this->writeAt(at, rows.data(), stored);
  }
}

void TileStore::setIfMissing(std::int64_t pixel, const double* values)
{
  const std::int64_t column = pixel % this->Grid.Columns;
  const std::int64_t row = pixel / this->Grid.Columns;
  const Lock lock(*this, column, row);
  std::uint64_t bits = 0;
  double word = 0;
  this->readAt(this->offset(column, row, 0), &word, 1);
  std::memcpy(&bits, &word, sizeof bits);
  for (std::size_t band = 0; bits == 0 && band < this->Bands; ++band)
  {
    const std::uint64_t encoded = encode(values[band]);
    std::memcpy(&word, &encoded, sizeof word);
    this->writeAt(this->offset(column, row, band), &word, 1);
  }
}

void TileStore::read(const RasterWindow& tile, std::vector<std::vector<double>>& values) const
{
  const Lock lock(*this, tile.Column, tile.Row);
  const auto width = std::size_t(tile.Columns);
  values.resize(this->Bands);
  for (std::size_t band = 0; band < this->Bands; ++band)
  {
    values[band].resize(width * std::size_t(tile.Rows));
    for (std::int64_t row = 0; row < tile.Rows; ++row)
    {
      double* const to = values[band].data() + std::size_t(row) * width;
      this->readAt(this->offset(tile.Column, tile.Row + row, band), to, width);
      for (std::size_t i = 0; i < width; ++i)
      {
        std::uint64_t bits;
        std::memcpy(&bits, to + i, sizeof bits);
        to[i] = decode(bits);
      }
    }
  }
}

} // namespace tipp
