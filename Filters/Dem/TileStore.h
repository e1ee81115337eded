// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTileStore_h
#define tippTileStore_h

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

/// A tile whose pixels all have values, as it goes to the raster's file.
struct FinishedTile
{
  std::int64_t Filled = 0; ///< pixels with a value in the first band
  EncodedTile Encoded;
};

/// Makes a finished tile of the values of its pixels. Called by several threads at once.
using FinishTile =
  std::function<FinishedTile(const RasterWindow&, std::vector<std::vector<double>>&)>;

/// The pixels of a raster in a file on disk, tile by tile, so that few of them are in memory.
/// A tile is encoded, and its pixels are removed, as soon as all of them are set: no later triangle
/// can change them. Pixels without a value take no space. Values may be set by several threads and
/// processes at once, and again after a process was killed, to the same values.
class VTKTIPPFILTERS_EXPORT TileStore
{
public:
  /// Opens the file, or creates it. `isSingle`: values are kept in 32 bits. `finish`: null if tiles
  /// are not to be encoded. Throws IOError.
  TileStore(const std::string& path, const RasterGrid& grid, std::size_t bands, bool isSingle,
    FinishTile finish);
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  /// Sets the pixels of a window that `isSet` marks; `values` has the window's pixels for each
  /// band.
  void set(const RasterWindow& window, const std::vector<unsigned char>& isSet,
    const std::vector<std::vector<double>>& values);

  /// Sets a pixel, by its index in the grid, if it has no value.
  void setIfMissing(std::int64_t pixel, const double* values);

  /// The values of a tile that is not finished, NaN where there is none.
  void read(const RasterWindow& tile, std::vector<std::vector<double>>& values) const;

  /// The tile of a number if it is finished.
  std::optional<FinishedTile> readFinished(std::int64_t tile) const;

private:
  struct State
  {
    std::uint32_t Set = 0;     ///< pixels
    std::uint32_t Encoded = 0; ///< bytes; 0: it is not finished
  };
  /// A window within one tile, in the values of a larger one.
  struct Source
  {
    RasterWindow Window;
    std::size_t First; ///< its first value
    std::size_t Width; ///< of the larger one
  };
  class Lock;

  template <typename Word>
  void setAs(const Source& source, const std::vector<unsigned char>& isSet,
    const std::vector<std::vector<double>>& values);
  template <typename Word>
  void setIfMissingAs(std::int64_t pixel, const double* values);
  template <typename Word>
  void readAs(const RasterWindow& tile, std::vector<std::vector<double>>& values) const;
  template <typename Word>
  void finish(std::int64_t tile);
  void writeFinished(std::int64_t tile, const FinishedTile& finished);

  std::int64_t tileAt(std::int64_t column, std::int64_t row) const;
  std::uint64_t pixelBytes() const;
  std::uint64_t encodedRoom() const;
  std::uint64_t begin(std::int64_t tile) const;
  std::uint64_t offset(
    std::int64_t column, std::int64_t row, std::size_t band, std::size_t wordSize) const;
  State stateOf(std::int64_t tile) const;
  void writeState(std::int64_t tile, State state) const;
  void readAt(std::uint64_t offset, void* words, std::size_t bytes) const;
  void writeAt(std::uint64_t offset, const void* words, std::size_t bytes) const;

  const std::string Path;
  const RasterGrid Grid;
  const std::size_t Bands;
  const bool IsSingle;
  const FinishTile Finish;
  int Descriptor;
  mutable std::array<std::mutex, 64> Mutexes; ///< each of some tiles
};

} // namespace tipp

#endif
