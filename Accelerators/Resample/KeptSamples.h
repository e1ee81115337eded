// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKeptSamples_h
#define tippKeptSamples_h

#include "Parallel/ParallelFor.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// The triangles that contain the samples of a lattice, and the samples' weights in them, kept so
/// that field after field can be interpolated without the mesh: the time steps of a simulation, for
/// example.
///
/// The samples are kept in tiles of 16 rows, whose triangles and values fit into the first cache.
/// Weights are rounded to 32 bits, since memory limits the speed: a sample differs from that of
/// resample() by at most 2^-23 of the largest difference between its corners' values, plus the
/// rounding of the result.
class VTKTIPPACCELERATORS_EXPORT KeptSamples
{
public:
  /// Finds the triangle of each sample, as claimSamples() does. The mesh needs fewer than 2^31
  /// points and triangles, and may be freed afterwards. Nothing if `report` stopped the work.
  static std::optional<KeptSamples> find(
    const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report = {});

  std::int64_t samples() const { return this->Width * this->Height; }
  /// The number of samples in triangles.
  std::int64_t inside() const { return this->Inside; }
  std::size_t bytes() const; ///< memory in use

  ///@{
  /// Return the mesh's points, or triangles, that samples use, ascending, and number them by their
  /// order among these from now on: the functions below take values of them alone. `count`: the
  /// number of points or triangles of the mesh.
  std::vector<std::int32_t> keepPoints(std::int64_t count);
  std::vector<std::int32_t> keepCells(std::int64_t count);
  ///@}
  /// Gives points other numbers: `numbers` has that of each. Several may have the same.
  void renumberPoints(const std::vector<std::int32_t>& numbers);

  /// Interpolates a field linearly from its values at the mesh's points. A sample is NaN outside of
  /// all triangles, and if a corner of its triangle is.
  void fromPoints(const double* values, float* samples, int threads) const;

  /// Interpolates two fields at once, which takes little more time than one. `values`: a value of
  /// the first field and one of the second per point.
  void pairFromPoints(const double* values, float* first, float* second, int threads) const;

  /// Takes a field from its values at the mesh's triangles. NaN outside.
  void fromCells(const double* values, float* samples, int threads) const;

  /// Interpolates a water level that is NaN at dry points. In triangles with wet and dry points,
  /// the dry points get the mean of the wet ones, and samples where the level is not above the
  /// ground are dry. `ground`: the ground's elevation at the samples. Dry samples are NaN.
  void waterLevel(const double* values, const float* ground, float* samples, int threads) const;

private:
  static constexpr std::int64_t TileRows = 16;
  static constexpr std::int64_t TileColumns = 64;
  static constexpr std::int64_t StripTiles = 32;

  /// The part of the lattice in a tile.
  struct TileBox
  {
    std::int64_t Row;
    std::int64_t Column;
    std::int64_t Rows;
    std::int64_t Columns;
  };

  /// A triangle of a tile, or an edge near which samples lie: points and the triangle's index.
  struct Slot
  {
    std::int32_t Points[3];
    std::int32_t Cell;
  };

  struct KeptSample
  {
    std::uint32_t Slot; ///< counted from the tile's first one
    ///@{ Weights of the slot's points; the first one has the remainder. NaN outside.
    float Second;
    float Third;
    ///@}
  };

  /// Consecutive tiles: the work of a thread at a time.
  struct Strip
  {
    std::vector<std::size_t> FirstSlots; ///< of each tile; each has one at least
    std::vector<Slot> Slots;
    std::vector<KeptSample> Samples; ///< tile by tile, row by row
  };

  class Builder;

  std::int64_t tileCount() const { return this->TilesAcross * this->TilesDown; }
  TileBox boxOf(std::int64_t tile) const;
  /// Calls work(slot) for all slots.
  template <typename Work>
  void forSlots(const Work& work);
  template <typename Work>
  void forTiles(int threads, const Work& work) const;
  /// Calls work(slot, kept, index) for all samples.
  template <typename Work>
  void forSamples(int threads, const Work& work) const;

  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t TilesAcross = 0;
  std::int64_t TilesDown = 0;
  std::int64_t Inside = 0;
  std::vector<Strip> Strips;
};

} // namespace tipp

#endif
