// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTileStore_h
#define tippTileStore_h

#include "Raster/RasterFile.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace tipp
{

/// The pixels of a raster in a file on disk, tile by tile, so that few of them are in memory.
/// Pixels without a value take no space. Values may be set by several threads and processes at
/// once, and again after a process was killed, to the same values.
class VTKTIPPFILTERS_EXPORT TileStore
{
public:
  /// Opens the file, or creates it. `isSingle`: values are kept in 32 bits. Throws IOError.
  TileStore(const std::string& path, const RasterGrid& grid, std::size_t bands, bool isSingle);
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  /// Sets the pixels of a window within one tile that `isSet` marks; `values` has the window's
  /// pixels for each band.
  void set(const RasterWindow& window, const std::vector<unsigned char>& isSet,
    const std::vector<std::vector<double>>& values);

  /// Sets a pixel, by its index in the grid, if it has no value.
  void setIfMissing(std::int64_t pixel, const double* values);

  /// The values of a tile, NaN where there is none.
  void read(const RasterWindow& tile, std::vector<std::vector<double>>& values) const;

private:
  template <typename Word>
  std::uint64_t offset(std::int64_t column, std::int64_t row, std::size_t band) const;
  template <typename Word>
  void setAs(const RasterWindow& window, const std::vector<unsigned char>& isSet,
    const std::vector<std::vector<double>>& values);
  template <typename Word>
  void setIfMissingAs(std::int64_t pixel, const double* values);
  template <typename Word>
  void readAs(const RasterWindow& tile, std::vector<std::vector<double>>& values) const;
  template <typename Word>
  class Lock;
  void readAt(std::uint64_t offset, void* words, std::size_t bytes) const;
  void writeAt(std::uint64_t offset, const void* words, std::size_t bytes) const;

  const std::string Path;
  const RasterGrid Grid;
  const std::size_t Bands;
  const bool IsSingle;
  int Descriptor;
  mutable std::array<std::mutex, 64> Mutexes; ///< each of some tiles
};

} // namespace tipp

#endif
