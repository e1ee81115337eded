// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTileStore_h
#define tippTileStore_h

#include "Dem/TerrainSampler.h"
#include "Files/OutputFile.h"
#include "Raster/RasterFile.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// A tile whose pixels are all set, encoded for the raster's file.
struct FinishedTile
{
  std::int64_t Filled = 0; ///< number of pixels with a value in the first band
  EncodedTile Encoded;
};

/// Encodes a tile from the values of its pixels. Must be thread-safe.
using FinishTile = std::function<FinishedTile(const RasterWindow&, BandValues&)>;

/// The pixels of a raster in a file, tile by tile, so that few of them are in memory. As soon as
/// set() has set all pixels of a tile, it is encoded and its pixels are removed: no later triangle
/// can change them. Pixels that are not set take no disk space. Several threads and processes may
/// set values at once. A run resumed after a crash may set the same values again.
class VTKTIPPFILTERS_EXPORT TileStore
{
public:
  /// Opens or creates the file. `isSingle` stores values in 32 bits. `finish` encodes tiles; null:
  /// tiles are not encoded. Throws IOError.
  TileStore(const std::string& path, const RasterGrid& grid, std::size_t bands, bool isSingle,
    FinishTile finish);

  /// Sets the pixels of a window that `isSet` marks; `values` has the window's pixels for each
  /// band. Unless it `replaces`, pixels that are already set stay, and a tile that becomes complete
  /// is not encoded.
  void set(const RasterWindow& window, const std::vector<unsigned char>& isSet,
    const BandValues& values, bool replaces = true);

  /// Sets a pixel, given by its index in the grid, if it has not been set. `values` has one value
  /// per band.
  void setIfMissing(std::int64_t pixel, const double* values);

  /// Reads the values of a tile that is not finished; NaN for pixels that are not set.
  void read(const RasterWindow& tile, BandValues& values) const;

  /// Returns the tile with this number if it is finished.
  std::optional<FinishedTile> readFinished(std::int64_t tile) const;

private:
  struct State
  {
    std::uint32_t Set = 0;     ///< number of pixels set
    std::uint32_t Encoded = 0; ///< size in bytes of the encoded tile; 0: not finished
  };
  class Lock;

  template <typename Word>
  void setInTile(std::int64_t tile, const RasterWindow& part, const RasterWindow& window,
    const std::vector<unsigned char>& isSet, const BandValues& values, bool replaces);
  template <typename Word>
  void readAs(const RasterWindow& tile, BandValues& values) const;
  void finish(std::int64_t tile);

  std::uint64_t wordBytes() const { return this->IsSingle ? sizeof(float) : sizeof(double); }
  std::uint64_t pixelBytes() const;
  std::uint64_t encodedRoom() const;
  std::uint64_t begin(std::int64_t tile) const;
  std::uint64_t offset(std::int64_t tile, const RasterWindow& part, std::size_t band) const;
  State stateOf(std::int64_t tile) const;
  void writeState(std::int64_t tile, State state) const;
  void readAt(std::uint64_t offset, void* words, std::size_t bytes) const;

  const OutputFile File; ///< open for reading, too
  const RasterGrid Grid;
  const std::size_t Bands;
  const bool IsSingle;
  const FinishTile Finish;
  mutable std::array<std::mutex, 64> Mutexes; ///< each guards some of the tiles
};

} // namespace tipp

#endif
