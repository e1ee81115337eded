// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/TileStore.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/Platform.h"
#include "Ranks/Archive.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fcntl.h>

namespace tipp
{
namespace
{

constexpr std::int64_t tilePixels = RasterTileSize * RasterTileSize;

/// The bit pattern for NaN values: a NaN that no computation produces.
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

/// The stored form of a value. 0 means that the pixel is not set, as in the holes of a sparse file.
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

int openStore(const std::string& path)
{
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0)
  {
    failToWrite(path);
  }
  return descriptor;
}

} // namespace

TileStore::TileStore(const std::string& path, const RasterGrid& grid, std::size_t bands,
  bool isSingle, FinishTile finish)
  : File(openStore(path), path)
  , Grid(grid)
  , Bands(bands)
  , IsSingle(isSingle)
  , Finish(std::move(finish))
{
}

std::uint64_t TileStore::pixelBytes() const
{
  return this->wordBytes() * std::uint64_t(tilePixels) * this->Bands;
}

/// The bytes reserved for an encoded tile, enough for incompressible data.
std::uint64_t TileStore::encodedRoom() const
{
  return this->pixelBytes() / 8 * 9 + 4096;
}

/// The offset of a tile's pixels. The file starts with the states of all tiles; then each tile has
/// its pixels and its encoded form. Unused parts of the file are holes.
std::uint64_t TileStore::begin(std::int64_t tile) const
{
  return sizeof(State) * std::uint64_t(tileCount(this->Grid)) +
    std::uint64_t(tile) * (this->pixelBytes() + this->encodedRoom());
}

/// The offset of the first pixel of a part of a tile; rows of a tile start in the north.
std::uint64_t TileStore::offset(std::int64_t tile, const RasterWindow& part, std::size_t band) const
{
  const std::int64_t fromNorth = this->Grid.Rows - part.Row - part.Rows;
  const std::int64_t pixel =
    fromNorth % RasterTileSize * RasterTileSize + part.Column % RasterTileSize;
  return this->begin(tile) +
    this->wordBytes() * (band * std::uint64_t(tilePixels) + std::uint64_t(pixel));
}

/// Locks a tile against other threads and processes.
class TileStore::Lock
{
public:
  Lock(const TileStore& store, std::int64_t tile)
    : Store(store)
    , Begin(store.begin(tile))
    , Thread(store.Mutexes[std::size_t(tile) % store.Mutexes.size()])
  {
    if (!this->setFileLock(F_WRLCK))
    {
      failToWrite(store.File.path());
    }
  }
  ~Lock() { this->setFileLock(F_UNLCK); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

private:
  bool setFileLock(short type) const
  {
    return setRangeLock(
      this->Store.File.descriptor(), type, off_t(this->Begin), off_t(this->Store.pixelBytes()));
  }

  const TileStore& Store;
  const std::uint64_t Begin;
  const std::lock_guard<std::mutex> Thread;
};

TileStore::State TileStore::stateOf(std::int64_t tile) const
{
  State state;
  this->readAt(std::uint64_t(tile) * sizeof state, &state, sizeof state);
  return state;
}

void TileStore::writeState(std::int64_t tile, State state) const
{
  this->File.write(std::uint64_t(tile) * sizeof state, &state, sizeof state);
}

/// Reads from the file; bytes beyond its end are 0.
void TileStore::readAt(std::uint64_t offset, void* words, std::size_t bytes) const
{
  const std::size_t done =
    readUpTo(this->File.descriptor(), this->File.path(), offset, words, bytes);
  std::memset(static_cast<char*>(words) + done, 0, bytes - done);
}

/// Sets pixels of a tile; `part` is the part of `window` in it. After a process was killed the
/// count of set pixels may be too low; then the tile is merely not finished early.
template <typename Word>
void TileStore::setInTile(std::int64_t tile, const RasterWindow& part, const RasterWindow& window,
  const std::vector<unsigned char>& isSet, const BandValues& values, bool replaces)
{
  const Lock lock(*this, tile);
  State state = this->stateOf(tile);
  if (state.Encoded > 0)
  {
    return; // a resumed run sets pixels again
  }
  const auto width = std::size_t(part.Columns);
  const auto first =
    std::size_t((part.Row - window.Row) * window.Columns + part.Column - window.Column);
  // The rows of a band are contiguous, the northernmost first.
  std::vector<Word> rows(std::size_t(part.Rows - 1) * std::size_t(RasterTileSize) + width);
  for (std::size_t band = 0; band < this->Bands; ++band)
  {
    const std::uint64_t at = this->offset(tile, part, band);
    this->readAt(at, rows.data(), rows.size() * sizeof(Word));
    std::uint32_t added = 0;
    for (std::size_t row = 0; row < std::size_t(part.Rows); ++row)
    {
      Word* const to =
        rows.data() + (std::size_t(part.Rows) - 1 - row) * std::size_t(RasterTileSize);
      const std::size_t from = first + row * std::size_t(window.Columns);
      for (std::size_t i = 0; i < width; ++i)
      {
        const bool isNew = to[i] == 0;
        const bool isChosen = isSet[from + i] != 0 && (replaces || isNew);
        added += std::uint32_t(isChosen && isNew);
        to[i] = isChosen ? encode<Word>(values[band][from + i]) : to[i];
      }
    }
    this->File.write(at, rows.data(), rows.size() * sizeof(Word));
    state.Set += band == 0 ? added : 0;
  }
  this->writeState(tile, state);
  const RasterWindow whole = tileOf(this->Grid, tile);
  // setIfMissing() runs in one thread; what it completes is encoded in parallel by writeTiles().
  if (replaces && this->Finish && state.Set == std::uint32_t(whole.Columns * whole.Rows))
  {
    this->finish(tile);
  }
}

/// Encodes a tile whose pixels are all set. The caller holds its lock.
void TileStore::finish(std::int64_t tile)
{
  const RasterWindow window = tileOf(this->Grid, tile);
  BandValues values;
  this->read(window, values);
  const FinishedTile finished = this->Finish(window, values);
  SaveArchive bytes;
  bytes(finished.Filled);
  for (const EncodedTile::Band& band : finished.Encoded.Bands)
  {
    bytes(band.Sums, band.Bytes);
  }
  if (bytes.size() > this->encodedRoom() ||
    bytes.size() > std::numeric_limits<std::uint32_t>::max())
  {
    return; // it is encoded when the raster is written
  }
  const std::uint64_t begin = this->begin(tile);
  this->File.write(begin + this->pixelBytes(), bytes.data(), bytes.size());
  State state = this->stateOf(tile);
  state.Encoded = std::uint32_t(bytes.size());
  this->writeState(tile, state);
  // Most pixels have not been written to the disk yet.
  freeRange(this->File.descriptor(), off_t(begin), off_t(this->pixelBytes()));
}

std::optional<FinishedTile> TileStore::readFinished(std::int64_t tile) const
{
  const State state = this->stateOf(tile);
  if (state.Encoded == 0)
  {
    return std::nullopt;
  }
  Bytes bytes(std::min<std::uint64_t>(state.Encoded, this->encodedRoom()));
  this->readAt(this->begin(tile) + this->pixelBytes(), bytes.data(), bytes.size());
  LoadArchive archive(bytes);
  FinishedTile finished;
  finished.Encoded.Bands.resize(this->Bands);
  try
  {
    archive(finished.Filled);
    for (EncodedTile::Band& band : finished.Encoded.Bands)
    {
      archive(band.Sums, band.Bytes);
    }
  }
  catch (const std::runtime_error&)
  {
    throw IOError(this->File.path(), "is damaged; remove its folder and start again.");
  }
  return finished;
}

template <typename Word>
void TileStore::readAs(const RasterWindow& tile, BandValues& values) const
{
  const auto width = std::size_t(tile.Columns);
  const auto height = std::size_t(tile.Rows);
  constexpr auto side = std::size_t(RasterTileSize);
  std::vector<Word> words((height - 1) * side + width);
  const std::int64_t number = tileNumber(this->Grid, tile);
  values.resize(this->Bands);
  for (std::size_t band = 0; band < this->Bands; ++band)
  {
    this->readAt(this->offset(number, tile, band), words.data(), words.size() * sizeof(Word));
    values[band].resize(width * height);
    for (std::size_t row = 0; row < height; ++row)
    {
      const Word* const from = words.data() + (height - 1 - row) * side;
      std::transform(
        from, from + width, values[band].begin() + std::ptrdiff_t(row * width), decode<Word>);
    }
  }
}

void TileStore::set(const RasterWindow& window, const std::vector<unsigned char>& isSet,
  const BandValues& values, bool replaces)
{
  forTiles(this->Grid, window,
    [&](std::int64_t tile, const RasterWindow& part)
    {
      this->IsSingle ? this->setInTile<std::uint32_t>(tile, part, window, isSet, values, replaces)
                     : this->setInTile<std::uint64_t>(tile, part, window, isSet, values, replaces);
    });
}

void TileStore::setIfMissing(std::int64_t pixel, const double* values)
{
  BandValues bands;
  for (std::size_t band = 0; band < this->Bands; ++band)
  {
    bands.push_back({ values[band] });
  }
  this->set({ pixel % this->Grid.Columns, pixel / this->Grid.Columns, 1, 1 }, { 1 }, bands, false);
}

void TileStore::read(const RasterWindow& tile, BandValues& values) const
{
  this->IsSingle ? this->readAs<std::uint32_t>(tile, values)
                 : this->readAs<std::uint64_t>(tile, values);
}

} // namespace tipp
